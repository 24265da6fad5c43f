// Species, for a law that calls for them: whether a particle is of a kind, or everybody is meant.
const EVERYBODY: u32 = 0xffffffffu;

fn is_of(index: u32, kind: u32) -> bool { return kind == EVERYBODY || species[index] == kind; }
