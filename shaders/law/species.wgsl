// Species, for laws that use them: whether a particle is of a given species, or the law acts on all.
const ALL_SPECIES: u32 = 0xffffffffu;

fn is_of(index: u32, kind: u32) -> bool { return kind == ALL_SPECIES || species[index] == kind; }
