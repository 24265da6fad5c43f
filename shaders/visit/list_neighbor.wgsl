// A particle on the list. `pair` is the index of the pair's history.
struct Particle { index: u32, position: vec3f, mass: f32, pair: u32 }

fn neighbor(id: u32, pair: u32) -> Particle {
    let p = position[id];
    return Particle(id, p.xyz, p.w, pair);
}

fn velocity_of(particle: Particle) -> vec3f { return velocity[particle.index].xyz; }
