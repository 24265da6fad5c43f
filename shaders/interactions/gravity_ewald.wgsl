// Newton's law in a periodic cube of side L, with a cut-off at half a side (the short-range part): the rest of all images and of the mean
// density is smooth, and is summed over Fourier modes (Ewald 1921). With ρ² = r² + ε² and v = 1 − (2 ρ / L)², as long as v > 0:
// φ = −G m [1 / ρ − (2 / L) P(v)],  a = G m [1 / ρ³ − 2 (2 / L)³ P′(v)] r.
// P is (1 − v)^(−1/2) to second order, so that the force and its slope vanish at the cut-off, plus higher orders that minimize the neglected Fourier modes.
struct Params { unused_word: u32, g: f32, softening: f32 }

@group(3) @binding(0) var<uniform> params: Params;

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let square = dot(r, r) + params.softening * params.softening;
    let inverse = inverseSqrt(square);
    let rate = 2.0 * world.frequency.x;
    let v = 1.0 - square * rate * rate;
    let mass = select(0.0, you.mass, v > 0.0);
    let value = 1.0 + v * (0.5 + v * (0.375 + v * (0.296344 + v * (0.309035 + v * (0.003588 + v * (0.434914 + v * (-0.227071 + v * 0.161508)))))));
    let slope = 1.0 + v * (1.5 + v * (1.778064 + v * (2.47228 + v * (0.03588 + v * (5.218968 + v * (-3.178994 + v * 2.584128))))));
    (*sum).acceleration += (mass * (inverse * inverse * inverse - rate * rate * rate * slope)) * r;
    (*sum).potential -= mass * (inverse - rate * value);
}

fn finish(me: Particle, sum: Sum) -> vec4f { return params.g * expansion() * vec4f(sum.acceleration, sum.potential); }
