// A fixed particle goes to its initial place, and mostly is there.
fn way(id: u32, motion: u32, home: vec3f, x: vec3f) -> Way { return Way(home - x, world.dt); }
