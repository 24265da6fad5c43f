// Wandering:  a = σ n / √dt, with n a random direction, drawn for every particle and step. So in the time t a velocity
// changes by σ² t in the mean square, for any time step.
struct Params { unused_word: u32, strength: f32, seed_low: u32, seed_high: u32, species: u32 }

@group(3) @binding(0) var<uniform> params: Params;

fn force(me: Particle) -> vec4f {
    if !is_of(me.index, params.species) { return vec4f(); }
    let words = pcg4d(vec4u(id_of(me.index), world.step, params.seed_low, params.seed_high));
    let way = circle(fraction(words.x) - 0.5);
    // Heights of a sphere are uniform (Archimedes); in the plane there is none.
    var z = 0.0;
    if world.dimensions == 3u { z = 2.0 * fraction(words.y) - 1.0; }
    let across = sqrt((1.0 - z) * (1.0 + z));
    return vec4f((params.strength * inverseSqrt(world.dt)) * vec3f(across * way, z), 0.0);
}
