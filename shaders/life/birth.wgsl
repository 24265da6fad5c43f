// When and how a particle is spawned, and from when on forces move it.
struct Birth { velocity: vec3f, time: f32, id: u32, mass: f32, free: f32 }

@group(2) @binding(0) var<storage, read> births: array<Birth>;
