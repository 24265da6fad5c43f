// A goal (seek and arrival; Reynolds 1999):  a = truncate(u − v, f_max),  u = v_max unit(r) min(1, |r| / r_slow);
// within r_free there is no steering (a roost).
struct Params {
    unused_word: u32,
    position: vec3f, velocity: vec3f, max_speed: f32, max_force: f32,
    slow_radius: f32, free_radius: f32, species: u32,
}

@group(3) @binding(0) var<uniform> params: Params;

fn force(me: Particle) -> vec4f {
    let r = shortest(params.position + params.velocity * world.time - me.position);
    let distance = length(r);
    if distance < params.free_radius || !is_of(me.index, params.species) { return vec4f(); }
    var speed = params.max_speed;
    if distance < params.slow_radius { speed *= distance / params.slow_radius; }
    return vec4f(truncated(speed * unit(r) - velocity_of(me), params.max_force), 0.0);
}
