// A particle of a fluid or a wall, from the cell list, before its pressure is known. Its density is looked up here, as a lane's own
// candidate: looked up for each pair it makes a step on lavapipe 1.8 times as long.
@group(2) @binding(5) var<storage, read> sorted_id: array<u32>;
@group(2) @binding(6) var<storage, read> sorted_position: array<vec4f>;
@group(2) @binding(7) var<storage, read> sorted_velocity: array<vec4f>;
@group(3) @binding(2) var<storage, read> density: array<f32>;

// Its density is 0 where it is of a wall.
struct Particle { index: u32, position: vec3f, mass: f32, velocity: vec3f, density: f32, pressure: f32, slot: u32 }

fn candidate(slot: u32) -> Particle {
    let p = sorted_position[slot];
    let id = sorted_id[slot];
    let known = select(density[id], 0.0, is_held(id));
    return Particle(id, p.xyz, p.w, sorted_velocity[slot].xyz, known, 0.0, slot);
}
