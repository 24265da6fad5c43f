// A step is done.
@group(0) @binding(0) var<storage, read_write> world: World;

@compute @workgroup_size(1)
fn tick() {
    world.step += 1u;
    world.time = f32(world.step) * world.dt;
}
