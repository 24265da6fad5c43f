// All particles are put into the grid.
fn chosen(i: u32) -> bool { return true; }
