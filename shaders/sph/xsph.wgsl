// Velocities drawn towards those of neighbours (XSPH: Monaghan 1989; as a viscosity: Schechter & Bridson 2012), as an acceleration:
//   a = ε / dt Σ m / ρ̄ (v_you − v_me) W
struct Params { unused_word: u32, xsph: f32 }
struct Sum { velocity: vec3f }

@group(3) @binding(0) var<uniform> params: Params;

fn acts_on(me: Particle) -> bool { return me.density > 0.0; }

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    // Walls have friction of their own.
    if you.density > 0.0 {
        (*sum).velocity += (you.mass / (0.5 * (me.density + you.density)) * kernel(r)) * (you.velocity - me.velocity);
    }
}

fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f((params.xsph / world.dt) * sum.velocity, 0.0); }
