// A particle of a fluid or a wall, on the list.
@group(3) @binding(3) var<storage, read> flow: array<vec4f>;

// Its density is 0 where it is of a wall; pressure is p / ρ²; its slot is its index.
struct Particle { index: u32, position: vec3f, mass: f32, velocity: vec3f, density: f32, pressure: f32, slot: u32, pair: u32 }

fn neighbor(id: u32, pair: u32) -> Particle {
    let p = position[id];
    let f = flow[id];
    return Particle(id, p.xyz, p.w, velocity[id].xyz, f.x, f.y, id, pair);
}
