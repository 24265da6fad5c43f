// A step is done, of this many ticks; a step of zero length does not count. Every sixteenth step records the growth of the maximum speed since
// the previous sixteen, unless an integrator limits its own error: its steps may grow while speeds do.
@group(0) @binding(0) var<storage, read_write> world: World;
// 5 the largest speed of these 16 steps, 6 of those before, 7 how often in a row it has more than doubled
@group(1) @binding(0) var<storage, read_write> alarm: array<u32>;
@group(1) @binding(1) var<storage, read_write> step_clock: array<u32>; // longest steps, ticks, ticks of this step

override UNIT: f32 = 1.0;
override WINDOW: u32 = 16u;
const TICKS: f32 = 16777216.0;

@compute @workgroup_size(1)
fn tick() {
    if step_clock[2] > 0u {
        let ticks = step_clock[1] + step_clock[2];
        step_clock[0] += ticks >> 24u;
        step_clock[1] = ticks & 0xffffffu;
        world.step += 1u;
        world.time = (f32(step_clock[0]) + f32(step_clock[1]) / TICKS) * UNIT;
        if world.step % WINDOW == 0u {
            let faster = bitcast<f32>(alarm[5]) > 2.0 * bitcast<f32>(alarm[6]);
            alarm[7] = select(0u, alarm[7] + 1u, faster);
            alarm[6] = alarm[5];
            alarm[5] = 0u;
        }
    }
}
