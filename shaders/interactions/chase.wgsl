// Chasing (seek; Reynolds 1999):  a = truncate(u − v, f_max),  u = v_max unit(Σ r), towards the mean position of the prey in range.
struct Params { unused_word: u32, max_speed: f32, max_force: f32, species: u32, prey: u32 }
struct Sum { displacement: vec3f }

@group(3) @binding(0) var<uniform> params: Params;

fn acts_on(me: Particle) -> bool { return is_of(me.index, params.species); }

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    if is_of(me.index, params.species) && is_of(you.index, params.prey) { (*sum).displacement += r; }
}

fn merge(total: ptr<function, Sum>, part: Sum) { (*total).displacement += part.displacement; }

// Without prey in range, and at the very centre of it, a predator flies straight on.
fn finish(me: Particle, sum: Sum) -> vec4f {
    let way = unit(sum.displacement);
    if all(way == vec3f()) { return vec4f(); }
    return vec4f(truncated(params.max_speed * way - velocity[me.index].xyz, params.max_force), 0.0);
}
