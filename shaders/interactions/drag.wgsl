// Drag in a medium, linear (Stokes 1851) and quadratic (Newton 1687):  a = −(γ + c |u|) u,  u = v − wind
struct Params { unused_word: u32, linear: f32, quadratic: f32, wind: vec3f }

@group(3) @binding(0) var<uniform> params: Params;

fn force(me: Particle) -> vec4f {
    let u = velocity[me.index].xyz - params.wind;
    return vec4f(-(params.linear + params.quadratic * length(u)) * u, 0.0);
}

fn jvp(me: Particle, dx: vec3f, dv: vec3f) -> vec3f {
    let u = velocity[me.index].xyz - params.wind;
    let speed = length(u);
    var slope = (params.linear + params.quadratic * speed) * dv;
    if speed > 0.0 { slope += (params.quadratic * dot(u, dv) / speed) * u; }
    return -slope;
}
