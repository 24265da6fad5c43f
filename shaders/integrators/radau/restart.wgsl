// Before the first iteration of a step.
@group(1) @binding(0) var<storage, read_write> radau_iteration: array<Iteration>;

@compute @workgroup_size(1)
fn radau_restart() { radau_iteration[0] = Iteration(0.0, 0.0, 0.0); }
