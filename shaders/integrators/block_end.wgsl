// A step with block time steps ends: World has the length of the whole step again.
@group(0) @binding(0) var<storage, read_write> world: World;

override UNIT: f32;

@compute @workgroup_size(1)
fn block_end() { world.dt = UNIT; }
