// Nothing is in the way of a drain.
fn is_free(x: vec3f, r: vec3f) -> bool { return true; }
