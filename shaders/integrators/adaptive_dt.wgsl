// The adaptive step:  dt = min over the limits, each given as the number of steps in a longest step; no more than a
// fifth above the last; shorter before a stop, which two equal steps reach rather than a long and a tiny one.
@group(0) @binding(0) var<storage, read_write> world: World;
// 0 and 1 the time in longest steps and ticks; 2 the ticks of this step, 3 those that only limits shorten, 4 reason, 5 particle;
// 6 to 9 the alarm: the step, reason, particle, how many; 10 and 11 the shortest and the longest; from 12 on steps by their reasons
@group(1) @binding(0) var<storage, read_write> step_clock: array<u32>;
@group(1) @binding(1) var<storage, read> largest_criterion: array<vec4f>; // how many steps acceleration, signal, speed and error want
@group(1) @binding(2) var<storage, read> step_clock_stop: array<u32>;

override UNIT: f32 = 1.0;        // the longest step
override LEAST: u32 = 1u;        // the ticks of the shortest
override VISCOUS: f32 = 0.0;     // the number of steps that viscosity requires
override RECORDS: u32 = 1u; // 0: the integrator records the length, since it may try a step again
const TICKS: f32 = 16777216.0;
const DIGITS: u32 = 11u;
const NONE: u32 = 4294967295u;
const GROWTH: u32 = 5u;
const STOP: u32 = 6u;
const ERROR: u32 = 7u;
const REASONS: u32 = 12u;

@compute @workgroup_size(1)
fn adaptive_dt() {
    var wants = array<f32, 4>(largest_criterion[0].x, largest_criterion[0].y, VISCOUS, largest_criterion[0].z);
    var rate = 1.0;
    var reason = 0u;
    for (var k = 0u; k < 4u; k += 1u) {
        if wants[k] > rate {
            rate = wants[k];
            reason = k + 1u;
        }
    }
    if largest_criterion[0].w > rate {
        rate = largest_criterion[0].w;
        reason = ERROR;
    }
    // Twelve digits tell lengths apart: what a division rounds, no device and no reference sees.
    var ticks = u32(TICKS / rate);
    let spare = max(firstLeadingBit(ticks), DIGITS) - DIGITS;
    ticks = (ticks >> spare) << spare;
    if ticks < LEAST {
        if step_clock[6] == NONE {
            step_clock[6] = world.step;
            step_clock[7] = reason;
            step_clock[9] = bitcast<u32>(rate);
        }
        ticks = LEAST;
    }
    let most = step_clock[3] + step_clock[3] / 5u;
    if ticks > most {
        ticks = most;
        reason = GROWTH;
    }
    let free = ticks;
    // Below three longest steps the distance fits.
    let whole = step_clock_stop[0] - step_clock[0];
    if step_clock_stop[0] < step_clock[0] {
        ticks = 0u;
        reason = STOP;
    } else if whole < 3u {
        let there = (whole << 24u) + step_clock_stop[1];
        let left = max(there, step_clock[1]) - step_clock[1];
        if left < ticks { reason = STOP; }
        if left <= ticks {
            ticks = left;
        } else if left < 2u * ticks {
            ticks = (left + 1u) / 2u;
            reason = STOP;
        }
    }
    step_clock[2] = ticks;
    step_clock[4] = reason;
    step_clock[5] = NONE;
    world.dt = (f32(ticks) / TICKS) * UNIT;
    // A step of no length leaves no trace in these.
    if ticks > 0u {
        step_clock[3] = free;
        if RECORDS == 1u {
            step_clock[10] = min(step_clock[10], ticks);
            step_clock[11] = max(step_clock[11], ticks);
        }
        step_clock[REASONS + reason] += 1u;
    }
}
