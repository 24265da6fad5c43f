// Whether a particle is held, where nobody is.
fn is_held(id: u32) -> bool { return false; }
