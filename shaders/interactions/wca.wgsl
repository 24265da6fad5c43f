// Atoms that only repel each other (Weeks, Chandler & Andersen 1971), with ε and σ of the pair of species:
//   U(r) = 4 ε [(σ / r)¹² − (σ / r)⁶] + ε  up to the minimum at 2^(1/6) σ.
struct Pair { unused_word: u32, epsilon: f32, sigma: f32, range: f32 }
struct Sum { force: vec3f, energy: f32 }

@group(3) @binding(1) var<uniform> pair_table: array<Pair, 64>; // of 8 species

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let pair = pair_table[pair_index(species[me.index], species[you.index])];
    if dot(r, r) < pair.range * pair.range {
        let inverse = inverseSqrt(dot(r, r));
        let square = pair.sigma * inverse * (pair.sigma * inverse);
        let sixth = square * square * square;
        (*sum).force += (24.0 * pair.epsilon * sixth * (1.0 - 2.0 * sixth) * inverse * inverse) * r;
        (*sum).energy += pair.epsilon * (4.0 * sixth * (sixth - 1.0) + 1.0);
    }
}

fn merge(total: ptr<function, Sum>, part: Sum) {
    (*total).force += part.force;
    (*total).energy += part.energy;
}

fn finish(me: Particle, sum: Sum) -> vec4f {
    // A particle without mass is moved by nothing.
    if me.mass > 0.0 { return vec4f(sum.force, sum.energy) / me.mass; }
    return vec4f();
}
