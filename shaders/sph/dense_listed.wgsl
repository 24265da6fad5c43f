// A particle of a fluid or a wall, on the list, before its pressure is known.
@group(3) @binding(2) var<storage, read> density: array<f32>;

// Its density is 0 where it is of a wall.
struct Particle { index: u32, position: vec3f, mass: f32, velocity: vec3f, density: f32, pair: u32 }

fn neighbor(id: u32, pair: u32) -> Particle {
    let p = position[id];
    let known = select(density[id], 0.0, is_held(id));
    return Particle(id, p.xyz, p.w, velocity[id].xyz, known, pair);
}
