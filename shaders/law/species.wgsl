// Species, for a law that calls for them: whether a particle is of a kind, or all are meant.
const ALL_SPECIES: u32 = 0xffffffffu;

fn is_of(index: u32, kind: u32) -> bool { return kind == ALL_SPECIES || species[index] == kind; }
