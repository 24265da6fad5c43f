// Atoms that only repel each other (Weeks, Chandler & Andersen 1971), with ε and σ of the pair of species:
//   U(r) = 4 ε [(σ / r)¹² − (σ / r)⁶] + ε  up to the minimum at 2^(1/6) σ.
struct Pair { unused_word: u32, epsilon: f32, sigma: f32, range: f32 }

@group(3) @binding(1) var<uniform> pair_table: array<Pair, 64>; // of 8 species

fn even_energy(me: Particle, you: Particle, square: f32, inverse: f32) -> Energy {
    let pair = pair_table[pair_index(species[me.index], species[you.index])];
    if square >= pair.range * pair.range { return Energy(); }
    let second = pair.sigma * pair.sigma * inverse;
    let sixth = second * second * second;
    return Energy(pair.epsilon * (4.0 * sixth * (sixth - 1.0) + 1.0), 24.0 * pair.epsilon * sixth * (1.0 - 2.0 * sixth) * inverse);
}
