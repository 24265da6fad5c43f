// A particle of a fluid or a wall, from the cell list, with the normal of its surface.
@group(2) @binding(5) var<storage, read> sorted_id: array<u32>;
@group(2) @binding(6) var<storage, read> sorted_position: array<vec4f>;
@group(3) @binding(3) var<storage, read> flow: array<vec4f>;
@group(3) @binding(4) var<storage, read> normal: array<vec4f>;

// Its density is 0 where it is of a wall.
struct Particle { index: u32, position: vec3f, mass: f32, density: f32, normal: vec3f }

fn candidate(slot: u32) -> Particle {
    let p = sorted_position[slot];
    return Particle(sorted_id[slot], p.xyz, p.w, flow[slot].x, normal[slot].xyz);
}
