// A soft wall: within a margin of the sides of a box a constant acceleration turns back;  φ = a · depth, axis by axis.
struct Params { unused_word: u32, low: vec3f, high: vec3f, margin: f32, acceleration: f32, species: u32 }

@group(3) @binding(0) var<uniform> params: Params;

fn force(me: Particle) -> vec4f {
    if !is_of(me.index, params.species) { return vec4f(); }
    var below = max(params.low + params.margin - me.position, vec3f());
    var above = max(me.position - (params.high - params.margin), vec3f());
    // In the plane there is no wall above it.
    if world.dimensions == 2u {
        below.z = 0.0;
        above.z = 0.0;
    }
    let back = sign(below) - sign(above);
    return params.acceleration * vec4f(back, dot(below + above, vec3f(1.0)));
}
