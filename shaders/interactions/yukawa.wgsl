// Screened charges (Debye & Hückel 1923; Yukawa 1935), with A and κ of the pair of species:  U(r) = A exp(−κ r) / r
struct Params { unused_word: u32, range: f32, onset: f32 }
struct Pair { @size(16) unused_word: u32, strength: f32, screening: f32, end_value: f32, end_slope: f32 }
struct Sum { force: vec3f, energy: f32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<uniform> pair_table: array<Pair, 64>; // of 8 species

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let pair = pair_table[pair_index(species[me.index], species[you.index])];
    let inverse = inverseSqrt(dot(r, r));
    let distance = dot(r, r) * inverse;
    let value = pair.strength * exp(-pair.screening * distance) * inverse;
    let here = Energy(value, -value * (pair.screening + inverse));
    let end = ended(here, Energy(pair.end_value, pair.end_slope), distance, params.range, params.onset);
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
