// The density at a particle, its rate of change, and the response factor α of pressure (Bender & Koschier 2015, with
// walls after Akinci et al. 2012: they have the pressure of the fluid particle, and are not accelerated). With V = m / ρ₀, r from me to you, and g r the gradient of W at you:
//   ρ / ρ₀ = Σ V W,  D = Σ V (v_you − v_me) · g r,  1 / α = (Σ V g r + Σ V g r, of walls) · Σ V g r + Σ V V' |g r|², without walls
struct Sum { number: f32, change: f32, gradient: vec3f, walls: vec3f, squares: f32, neighbors: f32 }

@group(3) @binding(2) var<storage, read_write> density: array<f32>;
@group(3) @binding(3) var<storage, read_write> responses: array<Response>;

// Of 1 / α times h²: a particle with less has no neighbours to push against.
const LEAST: f32 = 1e-6;

fn acts_on(me: Particle) -> bool { return !is_held(me.index); }

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let volume = you.mass / REST_DENSITY;
    let slope = gradient(r) * r;
    let v = you.velocity - me.velocity;
    (*sum).number += volume * kernel(r);
    (*sum).change += volume * dot(v, slope);
    (*sum).gradient += volume * slope;
    let wall = is_held(you.index);
    (*sum).walls += select(vec3f(), volume * slope, wall);
    (*sum).squares += select(volume * dot(slope, slope), 0.0, wall);
    (*sum).neighbors += 1.0;
}

fn finish(me: Particle, sum: Sum) {
    let volume = me.mass / REST_DENSITY;
    let number = sum.number + volume * kernel(vec3f());
    let inverse = dot(sum.gradient + sum.walls, sum.gradient) + volume * sum.squares;
    let resists = inverse > LEAST * PER_SUPPORT * PER_SUPPORT;
    density[me.index] = REST_DENSITY * number;
    responses[me.index] = Response(number - 1.0, select(0.0, 1.0 / inverse, resists), sum.change, sum.neighbors);
}
