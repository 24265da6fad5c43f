// A wind in gusts that travel downwind, and carry particles along:  a = γ (u − v),  u = (1 + s sin 2π (t/T − d/λ)) U
struct Params { unused_word: u32, velocity: vec3f, rate: f32, gust: f32, period: f32, wavelength: f32 }

@group(3) @binding(0) var<uniform> params: Params;

const TAU: f32 = 6.283185307;

fn force(me: Particle) -> vec4f {
    let speed = length(params.velocity);
    var along = 0.0;
    if speed > 0.0 { along = dot(me.position, params.velocity) / speed; }
    let phase = world.time / params.period - along / params.wavelength;
    let air = params.velocity * (1.0 + params.gust * circle(phase).y);
    return vec4f((air - velocity[me.index].xyz) * params.rate, 0.0);
}

fn jvp(me: Particle, dx: vec3f, dv: vec3f) -> vec3f {
    let speed = length(params.velocity);
    if speed <= 0.0 { return -params.rate * dv; }
    let way = params.velocity / speed;
    let phase = world.time / params.period - dot(me.position, way) / params.wavelength;
    let slope = -params.gust * circle(phase).x * (TAU / params.wavelength) * dot(way, dx);
    return params.rate * (slope * params.velocity - dv);
}
