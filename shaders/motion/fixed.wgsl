// A fixed particle moves to its initial position, where it usually is already.
fn way(id: u32, motion: u32, home: vec3f, x: vec3f) -> Way { return Way(home - x, world.dt); }
