// The row of two species in a table over pairs.
override SPECIES: u32 = 1u;

fn pair_index(a: u32, b: u32) -> u32 { return a * SPECIES + b; }
