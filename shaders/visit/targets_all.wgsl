// All particles are targets.
fn targets() -> u32 { return world.count; }
fn target_at(i: u32) -> Particle { return particle(i); }

// Sources for the targets of a workgroup, the first of which is `mine`.
fn sources_of(mine: u32) -> u32 { return world.count; }

// Whether none of a block of sources is one of so many targets from `mine` on.
fn is_apart(start: u32, block: u32, mine: u32, count: u32) -> bool { return start + block <= mine || start >= mine + count; }
