// Pedestrians keep the direction that they desire for models that set velocities.
@group(3) @binding(8) var<storage, read_write> desired_direction: array<vec4f>;

fn desire(i: u32, e: vec3f) { desired_direction[i] = vec4f(e, 0.0); }
