// The end of a step of fixed length.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> radau_step: array<f32>; // its length, 1 if it was accepted; 3 and 4 the number of steps that did not settle, and the first
@group(1) @binding(1) var<storage, read> radau_iteration: array<Iteration>;

@compute @workgroup_size(1)
fn radau_accept() {
    radau_step[0] = world.dt;
    radau_step[1] = 1.0;
    if radau_iteration[0].done == 0.0 {
        if radau_step[3] == 0.0 { radau_step[4] = f32(world.step); }
        radau_step[3] += 1.0;
    }
}
