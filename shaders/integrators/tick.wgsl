// A step is done; every sixteenth step records the growth of the maximum speed since the previous sixteen.
@group(0) @binding(0) var<storage, read_write> world: World;
// 5 the largest speed of these 16 steps, 6 of those before, 7 how often in a row it has more than doubled
@group(1) @binding(0) var<storage, read_write> alarm: array<u32>;

@compute @workgroup_size(1)
fn tick() {
    world.step += 1u;
    world.time = f32(world.step) * world.dt;
    if world.step % 16u == 0u {
        let faster = bitcast<f32>(alarm[5]) > 2.0 * bitcast<f32>(alarm[6]);
        alarm[7] = select(0u, alarm[7] + 1u, faster);
        alarm[6] = alarm[5];
        alarm[5] = 0u;
    }
}
