// Atoms that only repel each other (Weeks, Chandler & Andersen 1971), with ε and σ of the pair of species:
//   U(r) = 4 ε [(σ / r)¹² − (σ / r)⁶] + ε  up to the minimum at 2^(1/6) σ.
struct Pair { unused_word: u32, epsilon: f32, sigma: f32, range: f32 }

@group(3) @binding(1) var<uniform> pair_table: array<Pair, 64>; // of 8 species

fn energy(me: Particle, you: Particle, distance: f32, inverse: f32) -> Energy {
    let pair = pair_table[pair_index(species[me.index], species[you.index])];
    if distance >= pair.range { return Energy(); }
    let square = pair.sigma * inverse * (pair.sigma * inverse);
    let sixth = square * square * square;
    let value = pair.epsilon * (4.0 * sixth * (sixth - 1.0) + 1.0);
    return Energy(value, 24.0 * pair.epsilon * sixth * (1.0 - 2.0 * sixth) * inverse);
}
