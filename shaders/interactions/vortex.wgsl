// A vortex about an axis that carries particles along (Kaufmann 1962):  a = γ (u − v),  |u| = Γ r / 2π (r² + r_c²)
struct Params { unused_word: u32, center: vec3f, axis: vec3f, circulation: f32, core: f32, rate: f32 }

@group(3) @binding(0) var<uniform> params: Params;

const TAU: f32 = 6.283185307;

fn force(me: Particle) -> vec4f {
    let d = shortest(me.position - params.center);
    let across = d - params.axis * dot(params.axis, d);
    let flow = cross(params.axis, across) * (params.circulation / (TAU * (dot(across, across) + params.core * params.core)));
    return vec4f((flow - velocity[me.index].xyz) * params.rate, 0.0);
}

// The gradient of the flow is left out: it is not symmetric.
fn jvp(me: Particle, dx: vec3f, dv: vec3f) -> vec3f { return -params.rate * dv; }
