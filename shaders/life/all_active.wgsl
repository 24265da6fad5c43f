// All particles are active.
fn is_active(id: u32) -> bool { return true; }
