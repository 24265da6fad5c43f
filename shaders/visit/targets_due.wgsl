// The particles that are due are targets: their number, and their rows.
@group(2) @binding(2) var<storage, read> due_rows: array<u32>;

fn targets() -> u32 { return due_rows[0]; }
fn target_at(i: u32) -> Particle { return particle_at(due_rows[1u + min(i, max(targets(), 1u) - 1u)]); }

// Sources for the targets of a workgroup, the first of which is `mine`: none, if there is no such target.
fn sources_of(mine: u32) -> u32 { return select(0u, world.count, mine < targets()); }

// Targets are anywhere among the sources.
fn is_apart(start: u32, block: u32, mine: u32, count: u32) -> bool { return false; }
