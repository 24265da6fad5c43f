// Newton's law of gravity with the larger softening of a pair (Plummer 1911):  a = G m r / (r² + ε²)^(3/2),  φ = −G m / (r² + ε²)^(1/2),  ε = max(εᵢ, εⱼ)
struct Params { unused_word: u32, g: f32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<storage, read> softening_length: array<f32>;

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let e = max(softening_length[me.index], softening_length[you.index]);
    let inverse = inverseSqrt(r.x * r.x + (r.y * r.y + (r.z * r.z + e * e)));
    let potential = you.mass * inverse;
    (*sum).acceleration += (potential * inverse * inverse) * r;
    (*sum).potential -= potential;
}

fn finish(me: Particle, sum: Sum) -> vec4f { return params.g * vec4f(sum.acceleration, sum.potential); }
