// All particles are active.
fn lives(id: u32) -> bool { return true; }
