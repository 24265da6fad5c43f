// What the search for the list loads of a neighbour, where a load from anywhere costs one for each lane: the stored position with it.
struct Particle { index: u32, position: vec3f, slot: u32, stored: vec3f }

@group(2) @binding(5) var<storage, read> sorted_id: array<u32>;
@group(2) @binding(6) var<storage, read> sorted_position: array<vec4f>;

fn candidate(slot: u32) -> Particle {
    let index = sorted_id[slot];
    return Particle(index, sorted_position[slot].xyz, slot, position[index].xyz);
}

// The position as it is stored, and not its image in the box.
fn stored(particle: Particle) -> vec3f { return particle.stored; }
