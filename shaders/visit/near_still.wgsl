// A particle from the cell list, for a law that does not read velocities.
@group(2) @binding(5) var<storage, read> sorted_id: array<u32>;
@group(2) @binding(6) var<storage, read> sorted_position: array<vec4f>;

struct Particle { index: u32, position: vec3f, mass: f32, velocity: vec3f }

fn candidate(slot: u32) -> Particle {
    let p = sorted_position[slot];
    return Particle(sorted_id[slot], p.xyz, p.w, vec3f());
}

fn particle(i: u32) -> Particle {
    let p = position[i];
    return Particle(i, wrapped(p.xyz), p.w, vec3f());
}
