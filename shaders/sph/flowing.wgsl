// A particle of a fluid or a wall, from the cell list.
@group(2) @binding(5) var<storage, read> sorted_id: array<u32>;
@group(2) @binding(6) var<storage, read> sorted_position: array<vec4f>;
@group(2) @binding(7) var<storage, read> sorted_velocity: array<vec4f>;
@group(3) @binding(3) var<storage, read> flow: array<vec4f>;

// Its density is 0 where it is of a wall; pressure is p / ρ²; its slot is its place in the order of the cell list.
struct Particle { index: u32, position: vec3f, mass: f32, velocity: vec3f, density: f32, pressure: f32, slot: u32 }

fn candidate(slot: u32) -> Particle {
    let p = sorted_position[slot];
    let f = flow[slot];
    return Particle(sorted_id[slot], p.xyz, p.w, sorted_velocity[slot].xyz, f.x, f.y, slot);
}
