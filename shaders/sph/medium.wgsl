// A fluid at rest, and its smoothing kernel: see `src/sph/medium.rs`.
override PER_SUPPORT: f32;  // 1 / h
override WEIGHT: f32;       // W(r) = WEIGHT profile(r / h)
override SLOPE: f32;        // W'(r) / r = SLOPE profile_slope(r / h)
override SMOOTHING: f32;    // the smoothing length, which is half of h
override REST_DENSITY: f32; // at rest
override SOUND: f32;        // the speed of sound at rest
override STIFFNESS: f32;    // B of Tait's equation
override EXPONENT: u32;     // γ of it
override NEGATIVE: bool;    // whether pressure may be below 0

fn kernel(r: vec3f) -> f32 { return WEIGHT * profile(sqrt(r.x * r.x + r.y * r.y + r.z * r.z) * PER_SUPPORT); }

// The factor of r in the gradient of the kernel, for a particle at distance r.
fn gradient(r: vec3f) -> f32 { return SLOPE * profile_slope(sqrt(r.x * r.x + r.y * r.y + r.z * r.z) * PER_SUPPORT); }
