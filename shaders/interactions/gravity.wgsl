// Newton's law of gravity, softened (Plummer 1911):  a = G m r / (r² + ε²)^(3/2),  φ = −G m / (r² + ε²)^(1/2)
struct Params { unused_word: u32, g: f32, softening: f32 }

@group(3) @binding(0) var<uniform> params: Params;

// r² + ε², from ε² on: three steps of a multiply-add.
fn softened(r: vec3f) -> f32 { return r.x * r.x + (r.y * r.y + (r.z * r.z + params.softening * params.softening)); }

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let inverse = inverseSqrt(softened(r));
    let potential = you.mass * inverse;
    (*sum).acceleration += (potential * inverse * inverse) * r;
    (*sum).potential -= potential;
}

fn finish(me: Particle, sum: Sum) -> vec4f { return params.g * vec4f(sum.acceleration, sum.potential); }
