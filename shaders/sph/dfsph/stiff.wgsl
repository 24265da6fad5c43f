// A particle of a fluid or a wall, and its κ; that of walls is below 0.
@group(2) @binding(5) var<storage, read> sorted_id: array<u32>;
@group(2) @binding(6) var<storage, read> sorted_position: array<vec4f>;
@group(3) @binding(4) var<storage, read> unknowns: array<Unknown>;

struct Particle { index: u32, position: vec3f, mass: f32, stiffness: f32, slot: u32 }

fn candidate(slot: u32) -> Particle {
    let p = sorted_position[slot];
    return Particle(sorted_id[slot], p.xyz, p.w, unknowns[slot].stiffness, slot);
}
