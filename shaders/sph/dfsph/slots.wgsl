// A particle from the cell list, and its slot there.
@group(2) @binding(5) var<storage, read> sorted_id: array<u32>;
@group(2) @binding(6) var<storage, read> sorted_position: array<vec4f>;

struct Particle { index: u32, position: vec3f, slot: u32 }

fn candidate(slot: u32) -> Particle { return Particle(sorted_id[slot], sorted_position[slot].xyz, slot); }
