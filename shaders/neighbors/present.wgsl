// Every particle is in a slot of the cell list, or searches by id.
fn present() -> u32 { return world.count; }
