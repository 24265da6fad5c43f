// What the search for the list loads of a neighbour.
struct Particle { index: u32, position: vec3f, slot: u32 }

@group(2) @binding(5) var<storage, read> sorted_id: array<u32>;
@group(2) @binding(6) var<storage, read> sorted_position: array<vec4f>;

fn candidate(slot: u32) -> Particle { return Particle(sorted_id[slot], sorted_position[slot].xyz, slot); }

// The position as it is stored, and not its image in the box.
fn stored(particle: Particle) -> vec3f { return position[particle.index].xyz; }
