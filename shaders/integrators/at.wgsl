// Forces are evaluated at the time t = (step + c) dt: a product, never a sum, so that rounding does not grow.
@group(0) @binding(0) var<storage, read_write> world: World;

override FACTOR: f32 = 0.0;

@compute @workgroup_size(1)
fn at() { world.time = (f32(world.step) + FACTOR) * world.dt; }
