// The time with adaptive steps: in longest steps, and 2²⁴ths of one.
struct Now { whole: u32, rest: f32, unit: f32 }

@group(2) @binding(2) var<storage, read> step_clock: array<u32>;

override UNIT: f32 = 1.0; // the longest step
const TICKS: f32 = 16777216.0;

fn now(part: f32) -> Now { return Now(step_clock[0], (f32(step_clock[1]) + part * f32(step_clock[2])) / TICKS, UNIT); }

// The time at which the step began.
fn begun() -> f32 { return (f32(step_clock[0]) + f32(step_clock[1]) / TICKS) * UNIT; }
