// A particle, as passed to a law, where positions have two words, x = x₁ + x₂.
struct Particle { index: u32, position: vec3f, mass: f32, low: vec3f }

@group(1) @binding(7) var<storage, read> position_low: array<vec4f>; // xyz

// Lanes after the last particle repeat it; their results are not stored.
fn particle(i: u32) -> Particle {
    return particle_at(min(i, world.count - 1u));
}

// The particle of a row that is in use.
fn particle_at(index: u32) -> Particle { return particle_of(index, position[index], low_words_of(index)); }

// The particle of a row of positions and of the low words.
fn particle_of(index: u32, row: vec4f, low: vec3f) -> Particle { return Particle(index, row.xyz, row.w, low); }
fn low_words_of(index: u32) -> vec3f { return position_low[index].xyz; }

// The difference of two positions: that of the first words, which is exact for near particles (Sterbenz 1974), and that of the second ones,
// added before anything is rounded at the size of a coordinate. The first one passes through a zero that compilers cannot know: they might
// add the words of each position before.
fn refined(r: vec3f, me: Particle, you: Particle) -> vec3f {
    return bitcast<vec3f>(bitcast<vec3u>(r) ^ vec3u(world.zero)) + (you.low - me.low);
}

fn velocity_of(particle: Particle) -> vec3f { return velocity[particle.index].xyz; }
