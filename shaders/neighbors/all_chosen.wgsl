// All particles are put into the cell list.
fn chosen(i: u32) -> bool { return true; }
