// Space does not expand.
fn expansion() -> f32 { return 1.0; }
