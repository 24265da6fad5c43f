// Charges q in a periodic box, with a cut-off at R: the rest of all images is smooth, and is summed over Fourier modes (Ewald 1921):
// U(r) = k q q' [1 / r − P(1 − (r / R)²) / R]
struct Params {
    unused_word: u32,
    coulomb: f32,
    inverse_range: f32,
    taper_0: vec4f, // the coefficients of P from the constant on
    taper_1: vec4f,
    taper_2: vec4f,
    taper_3: vec4f,
    taper_4: vec4f,
    taper_5: vec4f,
    taper_6: vec4f,
}

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<storage, read> charge: array<f32>;

// The coefficients of P that there are, in vectors of four.
override VECTORS: u32 = 7u;

fn onward(at: vec2f, c: vec4f, v: f32) -> vec2f {
    let third = at * v + vec2f(c.w, at.x);
    let second = third * v + vec2f(c.z, third.x);
    let first = second * v + vec2f(c.y, second.x);
    return first * v + vec2f(c.x, first.x);
}

// P and P′ (after Kaiser & Schafer, IEEE Trans. ASSP 28, 105, 1980), by Horner's rule.
fn taper(v: f32) -> vec2f {
    var at = vec2f();
    if VECTORS > 6u { at = onward(at, params.taper_6, v); }
    if VECTORS > 5u { at = onward(at, params.taper_5, v); }
    if VECTORS > 4u { at = onward(at, params.taper_4, v); }
    if VECTORS > 3u { at = onward(at, params.taper_3, v); }
    at = onward(at, params.taper_2, v);
    at = onward(at, params.taper_1, v);
    return onward(at, params.taper_0, v);
}

fn energy(me: Particle, you: Particle, distance: f32, inverse: f32) -> Energy {
    let part = distance * params.inverse_range;
    let p = taper(1.0 - part * part);
    let charges = params.coulomb * charge[me.index] * charge[you.index];
    let smooth_slope = -2.0 * part * params.inverse_range * params.inverse_range * p.y;
    return Energy(charges * (inverse - params.inverse_range * p.x), charges * (-inverse * inverse - smooth_slope));
}
