// Whether a particle is fixed, in a simulation without fixed particles: none is.
fn is_held(id: u32) -> bool { return false; }
