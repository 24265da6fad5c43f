// Newton's law in a periodic cube of side L, with a cut-off at half a side (the short-range part): the rest of all images and of the mean
// density is smooth, and is summed over Fourier modes (Ewald 1921). With ρ² = r² + ε² and v = 1 − (2 r / L)², as long as v > 0:
// φ = −G m [1 / ρ − (2 / L) P(v)],  a = G m [1 / ρ³ − 2 (2 / L)³ P′(v)] r.
// P is a polynomial of a degree that grows with the accuracy (after Kaiser & Schafer, IEEE Trans. ASSP 28, 105, 1980).
struct Params {
    unused_word: u32,
    g: f32,
    softening: f32,
    taper_0: vec4f, // the coefficients of P from the constant on
    taper_1: vec4f,
    taper_2: vec4f,
    taper_3: vec4f,
    taper_4: vec4f,
    taper_5: vec4f,
    taper_6: vec4f,
}

@group(3) @binding(0) var<uniform> params: Params;

// Horner's rule for P and its first three derivatives over n!, from four coefficients on down.
fn onward(at: vec4f, c: vec4f, v: f32) -> vec4f {
    let third = at * v + vec4f(c.w, at.xyz);
    let second = third * v + vec4f(c.z, third.xyz);
    let first = second * v + vec4f(c.y, second.xyz);
    return first * v + vec4f(c.x, first.xyz);
}

fn taper(v: f32) -> vec4f {
    var at = onward(vec4f(), params.taper_6, v);
    at = onward(at, params.taper_5, v);
    at = onward(at, params.taper_4, v);
    at = onward(at, params.taper_3, v);
    at = onward(at, params.taper_2, v);
    at = onward(at, params.taper_1, v);
    return onward(at, params.taper_0, v);
}

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let square = dot(r, r);
    let inverse = inverseSqrt(square + params.softening * params.softening);
    let rate = 2.0 * world.frequency.x;
    let v = 1.0 - square * rate * rate;
    let mass = select(0.0, you.mass, v > 0.0);
    let p = taper(v);
    (*sum).acceleration += (mass * (inverse * inverse * inverse - 2.0 * rate * rate * rate * p.y)) * r;
    (*sum).potential -= mass * (inverse - rate * p.x);
}

fn finish(me: Particle, sum: Sum) -> vec4f { return params.g * expansion() * vec4f(sum.acceleration, sum.potential); }
