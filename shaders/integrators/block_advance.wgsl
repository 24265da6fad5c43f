// The next part of a step: as long as the shortest step of any particle. World has its length and the time of its end.
@group(0) @binding(0) var<storage, read_write> world: World;
@group(1) @binding(0) var<storage, read_write> block_clock: BlockClock;
// The largest level, the lowest id of those that require more than there are, the most that one requires, and the number of those due.
@group(1) @binding(1) var<storage, read_write> block_wanted: array<u32, 4>;

override LEVELS: u32;
// dt
override UNIT: f32;

@compute @workgroup_size(1)
fn block_advance() {
    let wanted = block_wanted;
    if wanted[1] != ~0u && block_clock.step == ~0u {
        block_clock.step = world.step;
        block_clock.particle = wanted[1];
        block_clock.level = wanted[2];
    }
    block_wanted = array<u32, 4>(0u, ~0u, 0u, 0u);
    let whole = 1u << LEVELS;
    let start = block_clock.now;
    let now = start + (1u << (LEVELS - wanted[0]));
    block_clock.start = start;
    block_clock.now = now;
    block_clock.done = select(0u, 1u, now == whole);
    block_clock.finest = wanted[0];
    block_clock.parts += 1u;
    if block_clock.parts == 0u { block_clock.more_parts += 1u; }
    block_clock.evaluations += wanted[3];
    if block_clock.evaluations < wanted[3] { block_clock.more_evaluations += 1u; }
    world.dt = f32(now - start) / f32(whole) * UNIT;
    world.time = (f32(world.step) + f32(now) / f32(whole)) * UNIT;
}
