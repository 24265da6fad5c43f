// What a law may read. A name that it does not use is not bound.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>; // xyz, mass
@group(1) @binding(1) var<storage, read> velocity: array<vec4f>; // xyz, radius

struct Particle { index: u32, position: vec3f, mass: f32 }

// Lanes behind the last particle repeat it; nothing of theirs is stored.
fn particle(i: u32) -> Particle {
    let index = min(i, world.count - 1u);
    let p = position[index];
    return Particle(index, p.xyz, p.w);
}
