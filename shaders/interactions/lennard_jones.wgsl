// Lennard-Jones atoms (Lennard-Jones 1931), with ε and σ of the pair of species:  U(r) = 4 ε [(σ / r)¹² − (σ / r)⁶]
struct Params { unused_word: u32, range: f32, onset: f32 }
struct Pair { @size(16) unused_word: u32, epsilon: f32, sigma: f32, end_value: f32, end_slope: f32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<uniform> pair_table: array<Pair, 64>; // of 8 species

fn energy(me: Particle, you: Particle, distance: f32, inverse: f32) -> Energy {
    let pair = pair_table[pair_index(species[me.index], species[you.index])];
    let square = pair.sigma * inverse * (pair.sigma * inverse);
    let sixth = square * square * square;
    let value = 4.0 * pair.epsilon * sixth * (sixth - 1.0);
    let here = Energy(value, 24.0 * pair.epsilon * sixth * (1.0 - 2.0 * sixth) * inverse);
    return ended(here, Energy(pair.end_value, pair.end_slope), distance, params.range, params.onset);
}
