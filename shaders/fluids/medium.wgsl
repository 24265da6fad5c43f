// A fluid at rest, and how it is smoothed: see `src/fluids/medium.rs`.
struct Medium {
    unused_word: u32,
    per_support: f32, // 1 / h
    weight: f32, // W(r) = weight bell(r / h)
    slope: f32, // W'(r) / r = slope decline(r / h)
    smoothing: f32, // the smoothing length, which is half of h
    density: f32, // at rest
    sound: f32, // the speed of sound at rest
    stiffness: f32, // B of Tait's equation
    exponent: u32, // γ of it
    negative: u32, // whether pressure may be below 0
}

@group(3) @binding(1) var<uniform> medium: Medium;

fn kernel(r: vec3f) -> f32 { return medium.weight * bell(sqrt(r.x * r.x + r.y * r.y + r.z * r.z) * medium.per_support); }

// What times r is the gradient of the kernel, for who stands r away.
fn gradient(r: vec3f) -> f32 { return medium.slope * decline(sqrt(r.x * r.x + r.y * r.y + r.z * r.z) * medium.per_support); }
