// States of particles in the order of the cell list.
@group(2) @binding(5) var<storage, read> sorted_id: array<u32>;

fn occupied() -> u32 { return present(); }

fn occupant(k: u32) -> u32 { return sorted_id[k]; }

fn has_state(id: u32) -> bool { return !is_held(id); }
