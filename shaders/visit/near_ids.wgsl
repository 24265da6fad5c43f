// Only some particles are in the cell list: all particles search, by id.
fn target_of(k: u32) -> Particle { return particle(k); }

fn same(k: u32, slot: u32, me: Particle) -> bool { return sorted_id[slot] == me.index; }
