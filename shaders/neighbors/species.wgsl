// One species is put into the grid.
fn chosen(i: u32) -> bool { return species[i] == grid.only; }
