// The end of a step of fixed length.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> radau_step: array<f32>; // its length, 1 if it was accepted

@compute @workgroup_size(1)
fn radau_accept() {
    radau_step[0] = world.dt;
    radau_step[1] = 1.0;
}
