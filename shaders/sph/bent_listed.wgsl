// A particle of a fluid or a wall, on the list, with the normal of its surface.
@group(3) @binding(3) var<storage, read> flow: array<vec4f>;
@group(3) @binding(4) var<storage, read> normal: array<vec4f>;

// Its density is 0 where it is of a wall.
struct Particle { index: u32, position: vec3f, mass: f32, density: f32, normal: vec3f, pair: u32 }

fn neighbor(id: u32, pair: u32) -> Particle {
    let p = position[id];
    return Particle(id, p.xyz, p.w, flow[id].x, normal[id].xyz, pair);
}
