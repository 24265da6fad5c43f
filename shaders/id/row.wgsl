// Particles are known by their rows.
fn id_of(index: u32) -> u32 { return index; }
