// Soft spheres (Groot & Warren 1997), with a of the pair of species:  U(r) = a R (1 − r / R)² / 2 up to the range R.
struct Params { unused_word: u32, range: f32 }
struct Pair { @size(12) unused_word: u32, strength: f32 }
struct Sum { force: vec3f, energy: f32 }

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<uniform> pair_table: array<Pair, 64>; // of 8 species

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let strength = pair_table[pair_index(species[me.index], species[you.index])].strength;
    let distance = length(r);
    let left = 1.0 - distance / params.range;
    // Two at one place have no direction between them.
    if distance > 0.0 { (*sum).force -= (strength * left / distance) * r; }
    (*sum).energy += 0.5 * strength * params.range * left * left;
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
