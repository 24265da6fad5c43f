// Screened charges (Debye & Hückel 1923; Yukawa 1935), with A and κ of the pair of species:  U(r) = A exp(−κ r) / r
struct Params { unused_word: u32, range: f32, onset: f32 }
struct Pair { @size(16) unused_word: u32, strength: f32, screening: f32, end_value: f32, end_slope: f32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<uniform> pair_table: array<Pair, 64>; // of 8 species

fn energy(me: Particle, you: Particle, distance: f32, inverse: f32) -> Energy {
    let pair = pair_table[pair_index(species[me.index], species[you.index])];
    let value = pair.strength * exp(-pair.screening * distance) * inverse;
    let here = Energy(value, -value * (pair.screening + inverse));
    return ended(here, Energy(pair.end_value, pair.end_slope), distance, params.range, params.onset);
}
