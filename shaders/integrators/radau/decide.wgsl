// The end of an adaptive step: from its error follow the length of the next one, dt (ε / e)^(1/7), and whether this one is tried again.
@group(0) @binding(0) var<storage, read_write> world: World;
@group(1) @binding(0) var<storage, read> radau_largest: array<vec4f>;     // change, acceleration, last difference
@group(1) @binding(1) var<storage, read_write> radau_step: array<f32>;    // its length, 1 if it was accepted, steps in a longest one; tries, the first
@group(1) @binding(2) var<storage, read_write> step_clock: array<u32>;    // 2 the ticks of this step, 4 its reason, 10 and 11 the shortest and the longest, from 12 on their numbers
@group(1) @binding(3) var<storage, read> radau_iteration: array<Iteration>;

override UNIT: f32 = 1.0;      // the longest step
override TOLERANCE: f32 = 0.0; // ε
override NOISE: f32 = 0.0;     // what rounding makes of e
// A step that is so many times too long is tried again.
const TOO_LONG: f32 = 4.0;
const LONGER: f32 = 16.0;
// How long a step is tried next whose iterations have not settled.
const UNSETTLED: f32 = 0.2;
const STOP: u32 = 6u;
const REASONS: u32 = 12u;

@compute @workgroup_size(1)
fn radau_decide() {
    if world.dt == 0.0 { return; }
    let all = radau_largest[0];
    let error = max(all.z - NOISE * all.y, 0.0);
    // (ε / e)^(1/7)
    var longer = LONGER;
    if error > 0.0 { longer = min(pow(TOLERANCE * all.y / error, 1.0 / 7.0), LONGER); }
    if radau_iteration[0].done == 0.0 { longer = min(longer, UNSETTLED); }
    let accepted = longer * TOO_LONG >= 1.0;
    let reason = step_clock[4];
    // A step that a stop shortened does not say that the next one must be as short.
    if !(accepted && reason == STOP && longer >= 1.0) { radau_step[2] = UNIT / (longer * world.dt); }
    radau_step[0] = world.dt;
    radau_step[1] = select(0.0, 1.0, accepted);
    if accepted {
        step_clock[10] = min(step_clock[10], step_clock[2]);
        step_clock[11] = max(step_clock[11], step_clock[2]);
    } else {
        if radau_step[3] == 0.0 { radau_step[4] = f32(world.step); }
        radau_step[3] += 1.0;
        step_clock[REASONS + reason] -= 1u;
        step_clock[2] = 0u;
        world.dt = 0.0;
    }
}
