// Ions (Born & Mayer 1932; Huggins & Mayer 1933), with coefficients of the pair of species, and charges q:
//   U(r) = A exp(−r / ρ) − C / r⁶ − D / r⁸ + k q q' erfc(α r) / r
// shifted so that energy and force end at the range R (Fennell & Gezelter 2006):  U(r) − U(R) − (r − R) U'(R).
struct Params { unused_word: u32, coulomb: f32, damping: f32, range: f32, end_value: f32, end_slope: f32, own: f32 }
struct Pair { @size(8) unused_word: u32, repulsion: f32, decay: f32, dispersion: f32, dispersion_8: f32, end_value: f32, end_slope: f32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<uniform> pair_table: array<Pair, 64>; // of 8 species
@group(3) @binding(2) var<storage, read> charge: array<f32>;

const TWO_BY_ROOT_PI: f32 = 1.1283791671;

// erfc(x), x ≥ 0, by exp(−x²), to 1.5e-7 (Abramowitz & Stegun 1964, 7.1.26).
fn erfc(x: f32, gaussian: f32) -> f32 {
    let t = 1.0 / (1.0 + 0.3275911 * x);
    return t * (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429)))) * gaussian;
}

fn energy(me: Particle, you: Particle, distance: f32, inverse: f32) -> Energy {
    let pair = pair_table[pair_index(species[me.index], species[you.index])];
    let square = inverse * inverse;
    let sixth = square * square * square;

    let repulsion = pair.repulsion * exp(-distance / pair.decay);
    var value = repulsion - (pair.dispersion + pair.dispersion_8 * square) * sixth - pair.end_value;
    var slope = (6.0 * pair.dispersion + 8.0 * pair.dispersion_8 * square) * sixth * inverse - repulsion / pair.decay - pair.end_slope;

    let x = params.damping * distance;
    let gaussian = exp(-x * x);
    let near = erfc(x, gaussian) * inverse;
    let charges = params.coulomb * charge[me.index] * charge[you.index];
    value += charges * (near - params.end_value);
    slope -= charges * ((near + TWO_BY_ROOT_PI * params.damping * gaussian) * inverse + params.end_slope);

    let shift = pair.end_slope + charges * params.end_slope;
    return Energy(value - (distance - params.range) * shift, slope);
}

fn finish(me: Particle, sum: Sum) -> vec4f {
    // A particle without mass is moved by nothing.
    if me.mass > 0.0 { return vec4f(sum.force, sum.energy + params.own * charge[me.index] * charge[me.index]) / me.mass; }
    return vec4f();
}
