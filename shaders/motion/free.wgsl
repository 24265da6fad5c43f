// Whether a particle is fixed, where none is.
fn is_held(id: u32) -> bool { return false; }
