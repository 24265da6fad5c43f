// Density by summation:  ρ = Σ m W(r), over all in range and the particle itself, for particles of the fluid only.
struct Sum { density: f32 }

@group(3) @binding(2) var<storage, read_write> density: array<f32>;

fn acts_on(me: Particle) -> bool { return !is_held(me.index); }

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) { (*sum).density += you.mass * kernel(r); }

fn finish(me: Particle, sum: Sum) { density[me.index] = sum.density + me.mass * kernel(vec3f()); }
