// States of particles by their indices.
fn occupied() -> u32 { return world.count; }

fn occupant(k: u32) -> u32 { return k; }

fn has_state(id: u32) -> bool { return is_active(id) && !is_held(id); }
