// A particle, as passed to a law.
struct Particle { index: u32, position: vec3f, mass: f32 }

// Lanes after the last particle repeat it; their results are not stored.
fn particle(i: u32) -> Particle {
    return particle_at(min(i, world.count - 1u));
}

// The particle of a row that is in use.
fn particle_at(index: u32) -> Particle { return particle_of(index, position[index], vec3f()); }

// The particle of a row of positions, and of the low words, which there are none of.
fn particle_of(index: u32, row: vec4f, low: vec3f) -> Particle { return Particle(index, row.xyz, row.w); }
fn low_words_of(index: u32) -> vec3f { return vec3f(); }

// The difference of two positions, which is all there is of it.
fn refined(r: vec3f, me: Particle, you: Particle) -> vec3f { return r; }

fn velocity_of(particle: Particle) -> vec3f { return velocity[particle.index].xyz; }
