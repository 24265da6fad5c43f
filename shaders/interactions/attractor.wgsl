// A centre that attracts:  point φ = −k / √(d² + ε²),  harmonic φ = k d² / 2,  logarithmic φ = k ln(d² + ε²) / 2
struct Params { unused_word: u32, position: vec3f, velocity: vec3f, strength: f32, softening: f32, profile: u32 }

@group(3) @binding(0) var<uniform> params: Params;

fn force(me: Particle) -> vec4f {
    let d = shortest(me.position - (params.position + params.velocity * world.time));
    let soft = dot(d, d) + params.softening * params.softening;
    var pull: f32;
    var potential: f32;
    if params.profile == 0u {
        let inverse = inverseSqrt(soft);
        pull = params.strength * inverse * inverse * inverse;
        potential = -params.strength * inverse;
    } else if params.profile == 1u {
        pull = params.strength;
        potential = 0.5 * params.strength * dot(d, d);
    } else {
        pull = params.strength / soft;
        potential = 0.5 * params.strength * log(soft);
    }
    return vec4f(-pull * d, potential);
}

// Of the harmonic profile.
fn jvp(me: Particle, dx: vec3f, dv: vec3f) -> vec3f { return -params.strength * dx; }
