// Every particle stands in a slot of the grid, or looks around by id.
fn present() -> u32 { return world.count; }
