// Charges q, with a dielectric continuum beyond the range R (Barker & Watts 1973; Tironi et al. 1995):  U(r) = k q q' (1 / r + A r² − B)
struct Params { unused_word: u32, coulomb: f32, growth: f32, shift: f32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<storage, read> charge: array<f32>;

fn energy(me: Particle, you: Particle, distance: f32, inverse: f32) -> Energy {
    let charges = params.coulomb * charge[me.index] * charge[you.index];
    let value = inverse + params.growth * distance * distance - params.shift;
    return Energy(charges * value, charges * (2.0 * params.growth * distance - inverse * inverse));
}
