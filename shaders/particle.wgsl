// A particle, as passed to a law.
struct Particle { index: u32, position: vec3f, mass: f32 }

// Lanes after the last particle repeat it; their results are not stored.
fn particle(i: u32) -> Particle {
    let index = min(i, world.count - 1u);
    let p = position[index];
    return Particle(index, p.xyz, p.w);
}

fn velocity_of(particle: Particle) -> vec3f { return velocity[particle.index].xyz; }
