// Forces are evaluated at the time t + c dt, by a clock that counts ticks.
@group(0) @binding(0) var<storage, read_write> world: World;
@group(1) @binding(0) var<storage, read> step_clock: array<u32>; // longest steps, ticks, ticks of this step

override FACTOR: f32 = 0.0;
override UNIT: f32 = 1.0;
const TICKS: f32 = 16777216.0;

@compute @workgroup_size(1)
fn at() { world.time = (f32(step_clock[0]) + (f32(step_clock[1]) + FACTOR * f32(step_clock[2])) / TICKS) * UNIT; }
