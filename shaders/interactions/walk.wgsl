// The drive of pedestrians (Helbing & Molnár 1995):  a = (v₀ e − v) / τ,  along a direction, or to a target.
struct Params {
    unused_word: u32,
    direction: vec3f, relaxation_time: f32, destination: vec3f, to_target: u32, species: u32,
}

@group(3) @binding(0) var<uniform> params: Params;
@group(3) @binding(1) var<storage, read> desired_speed: array<f32>;

fn force(me: Particle) -> vec4f {
    if !is_of(me.index, params.species) { return vec4f(); }
    var way = params.direction;
    if params.to_target > 0u { way = unit(shortest(params.destination - me.position)); }
    desire(me.index, way);
    return vec4f((desired_speed[me.index] * way - velocity_of(me)) / params.relaxation_time, 0.0);
}
