// Lennard-Jones atoms (Lennard-Jones 1931), with ε and σ of the pair of species:  U(r) = 4 ε [(σ / r)¹² − (σ / r)⁶]
struct Params { unused_word: u32, range: f32, onset: f32 }
struct Pair { @size(16) unused_word: u32, epsilon: f32, sigma: f32, end_value: f32, end_slope: f32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<uniform> pair_table: array<Pair, 64>; // of 8 species

fn even_energy(me: Particle, you: Particle, square: f32, inverse: f32) -> Energy {
    let pair = pair_table[pair_index(species[me.index], species[you.index])];
    let second = pair.sigma * pair.sigma * inverse;
    let sixth = second * second * second;
    let strength = pair.epsilon * sixth;
    let here = Energy(4.0 * strength * (sixth - 1.0), 24.0 * strength * (1.0 - 2.0 * sixth) * inverse);
    return even_ended(here, Energy(pair.end_value, pair.end_slope), square, params.range, params.onset);
}
