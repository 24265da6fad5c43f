// Boids (Reynolds 1987, 1999). Over the n neighbours in range and in view:
//   separation  s = −Σ r / r², within a range of its own;  cohesion  c = Σ r / n;  both are directions: u = v_max unit(…)
//   alignment   u = Σ v / n, which is not normalized
//   a = truncate(Σ w truncate(u − v, f_max), f_max)
struct Params {
    unused_word: u32,
    separation_range: f32, separation: f32, alignment: f32, cohesion: f32,
    cosine: f32, max_speed: f32, max_force: f32, species: u32,
}
struct Sum { separation: vec3f, neighbors: u32, velocity: vec3f, displacement: vec3f }

@group(3) @binding(0) var<uniform> params: Params;

// Coincident particles have no direction of separation.
const COINCIDENT: f32 = 1e-30;

fn acts_on(me: Particle) -> bool { return is_of(me.index, params.species); }

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let d2 = r.x * r.x + r.y * r.y + r.z * r.z;
    let v = velocity_of(me);
    // A bird at rest sees in all directions, and sees coincident birds, too.
    let seen = dot(v, r) >= params.cosine * sqrt(dot(v, v) * d2);
    if seen && is_of(me.index, params.species) && is_of(you.index, params.species) {
        if d2 < params.separation_range * params.separation_range && d2 > COINCIDENT { (*sum).separation -= r / d2; }
        (*sum).neighbors += 1u;
        (*sum).velocity += velocity_of(you);
        (*sum).displacement += r;
    }
}

fn merge(total: ptr<function, Sum>, part: Sum) {
    (*total).separation += part.separation;
    (*total).neighbors += part.neighbors;
    (*total).velocity += part.velocity;
    (*total).displacement += part.displacement;
}

// Steering to full speed along a direction; zero for a zero vector.
fn toward(way: vec3f, v: vec3f) -> vec3f {
    if dot(way, way) > 0.0 { return truncated(params.max_speed * unit(way) - v, params.max_force); }
    return vec3f();
}

fn finish(me: Particle, sum: Sum) -> vec4f {
    if sum.neighbors == 0u { return vec4f(); }
    let v = velocity_of(me);
    let a = params.separation * toward(sum.separation, v)
        + params.alignment * truncated(sum.velocity / f32(sum.neighbors) - v, params.max_force)
        + params.cohesion * toward(sum.displacement, v);
    return vec4f(truncated(a, params.max_force), 0.0);
}
