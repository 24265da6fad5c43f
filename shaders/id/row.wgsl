// The id of a particle is its row.
fn id_of(index: u32) -> u32 { return index; }
