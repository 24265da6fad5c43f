// The spawn time and velocity of a particle, and the time from which forces act on it.
struct Birth { velocity: vec3f, time: f32, id: u32, mass: f32, free: f32 }

@group(2) @binding(0) var<storage, read> births: array<Birth>;
