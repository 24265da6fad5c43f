// Whether a particle is held, where none is.
fn is_held(id: u32) -> bool { return false; }
