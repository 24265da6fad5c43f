// One species is put into the cell list.
fn chosen(i: u32) -> bool { return species[i] == grid.only; }
