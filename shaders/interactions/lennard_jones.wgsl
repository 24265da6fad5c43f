// Lennard-Jones atoms (Lennard-Jones 1931), with ε and σ of the pair of species:  U(r) = 4 ε [(σ / r)¹² − (σ / r)⁶]
struct Params { unused_word: u32, range: f32, onset: f32 }
struct Pair { @size(16) unused_word: u32, epsilon: f32, sigma: f32, end_value: f32, end_slope: f32 }
struct Sum { force: vec3f, energy: f32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<uniform> pair_table: array<Pair, 64>; // of 8 species

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let pair = pair_table[pair_index(species[me.index], species[you.index])];
    let inverse = inverseSqrt(dot(r, r));
    let square = pair.sigma * inverse * (pair.sigma * inverse);
    let sixth = square * square * square;
    let value = 4.0 * pair.epsilon * sixth * (sixth - 1.0);
    let slope = 24.0 * pair.epsilon * sixth * (1.0 - 2.0 * sixth) * inverse;
    let end = ended(Energy(value, slope), Energy(pair.end_value, pair.end_slope), dot(r, r) * inverse, params.range, params.onset);
    (*sum).force += (end.slope * inverse) * r;
    (*sum).energy += end.value;
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
