// Positions and velocities in two words: saved, put back, and at a part of the step:  x ← x₀ + h dt v₀ + Δx,  v ← v₀ + Δv.
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>;     // xyz, mass
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>;     // xyz, radius
@group(1) @binding(2) var<storage, read_write> position_low: array<vec4f>; // xyz
@group(1) @binding(3) var<storage, read_write> velocity_low: array<vec4f>; // xyz

fn save(i: u32) {
    step_start[i * SLOTS] = position[i];
    step_start[i * SLOTS + START_VELOCITY] = velocity[i];
    step_start[i * SLOTS + LOW_POSITION] = position_low[i];
    step_start[i * SLOTS + LOW_VELOCITY] = velocity_low[i];
}

fn back(i: u32) {
    position[i] = step_start[i * SLOTS];
    velocity[i] = step_start[i * SLOTS + START_VELOCITY];
    position_low[i] = step_start[i * SLOTS + LOW_POSITION];
    velocity_low[i] = step_start[i * SLOTS + LOW_VELOCITY];
}

// In single precision the step is short of what `rest()` says. The product of the step and the velocity keeps its digits: it is the
// largest term by far.
fn go(i: u32) {
    let by = change(i);
    let x = step_start[i * SLOTS];
    let v = step_start[i * SLOTS + START_VELOCITY];
    let x_low = step_start[i * SLOTS + LOW_POSITION].xyz;
    let v_low = step_start[i * SLOTS + LOW_VELOCITY].xyz;
    let h = H * world.dt;
    let straight = two_product(h, v.xyz);
    let moved = two_sum(x.xyz, straight.high);
    let curved = two_sum(moved.high, by.curve);
    let next = fast_two_sum(curved.high, curved.low + (moved.low + (x_low + (straight.low + (h * v_low + rest() * v.xyz)))));
    let sum = two_sum(v.xyz, by.velocity);
    let faster = fast_two_sum(sum.high, sum.low + v_low);
    position[i] = vec4f(next.high, x.w);
    position_low[i] = vec4f(next.low, 0.0);
    velocity[i] = vec4f(faster.high, v.w);
    velocity_low[i] = vec4f(faster.low, 0.0);
}
