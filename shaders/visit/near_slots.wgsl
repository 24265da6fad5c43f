// All particles are in the cell list: the one in a slot looks around, so that neighbours look at the same places.
fn target_of(k: u32) -> Particle { return candidate(k); }

fn same(k: u32, slot: u32, me: Particle) -> bool { return slot == k; }
