// What the step in single precision lacks: it is a number of ticks, each a part of the longest step, which is UNIT + UNIT_REST.
@group(3) @binding(0) var<storage, read> step_clock: array<u32>; // 2 the ticks of this step

override UNIT: f32 = 1.0;
override UNIT_REST: f32 = 0.0;
const TICKS: f32 = 16777216.0;

fn rest() -> f32 {
    let part = f32(step_clock[2]) / TICKS;
    return H * (two_product(part, vec3f(UNIT)).low.x + part * UNIT_REST);
}
