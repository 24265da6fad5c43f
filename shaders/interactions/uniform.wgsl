// The same acceleration everywhere:  a = g,  φ = −g · x
struct Params { unused_word: u32, acceleration: vec3f }

@group(3) @binding(0) var<uniform> params: Params;

fn force(me: Particle) -> vec4f {
    return vec4f(params.acceleration, -dot(params.acceleration, me.position));
}
