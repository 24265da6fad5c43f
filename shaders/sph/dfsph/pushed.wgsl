// A particle of a fluid or a wall, and its acceleration, which is 0 for walls. The fourth component distinguishes them.
@group(2) @binding(5) var<storage, read> sorted_id: array<u32>;
@group(2) @binding(6) var<storage, read> sorted_position: array<vec4f>;
@group(3) @binding(5) var<storage, read> pushes: array<vec4f>;

struct Particle { index: u32, position: vec3f, mass: f32, push: vec3f, solved: f32, slot: u32 }

fn candidate(slot: u32) -> Particle {
    let p = sorted_position[slot];
    let push = pushes[slot];
    return Particle(sorted_id[slot], p.xyz, p.w, push.xyz, push.w, slot);
}
