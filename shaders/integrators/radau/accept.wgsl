// The end of a step of fixed length.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> radau_step: array<f32>; // its length, 1 if it was accepted
@group(1) @binding(1) var<storage, read> radau_iteration: array<Iteration>;
@group(1) @binding(2) var<storage, read_write> radau_unsettled: array<u32>; // the number of steps whose iterations did not settle, and the first

@compute @workgroup_size(1)
fn radau_accept() {
    radau_step[0] = world.dt;
    radau_step[1] = 1.0;
    if radau_iteration[0].done == 0.0 {
        if radau_unsettled[0] == 0u { radau_unsettled[1] = world.step; }
        radau_unsettled[0] += 1u;
    }
}
