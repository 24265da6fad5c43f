// All groups of targets walk.
fn is_wanted(group: u32) -> bool { return true; }
