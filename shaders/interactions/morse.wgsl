// Morse's energy of a bond (Morse 1929), with D, α and r₀ of the pair of species:  U(r) = D (e² − 2 e),  e = exp(−α (r − r₀))
struct Params { unused_word: u32, range: f32, onset: f32 }
struct Pair { @size(12) unused_word: u32, depth: f32, steepness: f32, distance: f32, end_value: f32, end_slope: f32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<uniform> pair_table: array<Pair, 64>; // of 8 species

fn energy(me: Particle, you: Particle, distance: f32, inverse: f32) -> Energy {
    let pair = pair_table[pair_index(species[me.index], species[you.index])];
    let e = exp(-pair.steepness * (distance - pair.distance));
    let here = Energy(pair.depth * e * (e - 2.0), 2.0 * pair.depth * pair.steepness * e * (1.0 - e));
    return ended(here, Energy(pair.end_value, pair.end_slope), distance, params.range, params.onset);
}
