// No model needs the desired direction.
fn desire(i: u32, e: vec3f) {}
