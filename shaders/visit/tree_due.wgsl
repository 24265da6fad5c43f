// Groups of targets of which one is due walk.
fn is_wanted(group: u32) -> bool { return tree_demand[group] >= 0.0; }
