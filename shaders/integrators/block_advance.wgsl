// The next part of a step: as long as the shortest step of any particle. World has its length and the time of its end.
@group(0) @binding(0) var<storage, read_write> world: World;
@group(1) @binding(0) var<storage, read_write> block_clock: array<BlockClock>;
// The largest level, the lowest id of those that require more than there are, the most that one requires, and the number of those due.
@group(1) @binding(1) var<storage, read_write> block_wanted: array<u32>;

override LEVELS: u32;
// dt
override UNIT: f32;

@compute @workgroup_size(1)
fn block_advance() {
    let finest = block_wanted[0];
    let lacking = block_wanted[1];
    let due = block_wanted[3];
    if lacking != ~0u && block_clock[0].step == ~0u {
        block_clock[0].step = world.step;
        block_clock[0].particle = lacking;
        block_clock[0].level = block_wanted[2];
    }
    block_wanted[0] = 0u;
    block_wanted[1] = ~0u;
    block_wanted[2] = 0u;
    block_wanted[3] = 0u;
    let whole = 1u << LEVELS;
    let start = block_clock[0].now;
    let now = start + (1u << (LEVELS - finest));
    block_clock[0].start = start;
    block_clock[0].now = now;
    block_clock[0].done = select(0u, 1u, now == whole);
    block_clock[0].finest = finest;
    block_clock[0].parts += 1u;
    if block_clock[0].parts == 0u { block_clock[0].more_parts += 1u; }
    block_clock[0].evaluations += due;
    if block_clock[0].evaluations < due { block_clock[0].more_evaluations += 1u; }
    world.dt = f32(now - start) / f32(whole) * UNIT;
    world.time = (f32(world.step) + f32(now) / f32(whole)) * UNIT;
}
