// Positions and velocities: saved, put back, and at a part of the step:  x ← x₀ + h dt v₀ + Δx,  v ← v₀ + Δv.
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>; // xyz, mass
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>; // xyz, radius

fn save(i: u32) {
    step_start[i * SLOTS] = position[i];
    step_start[i * SLOTS + START_VELOCITY] = velocity[i];
}

fn back(i: u32) {
    position[i] = step_start[i * SLOTS];
    velocity[i] = step_start[i * SLOTS + START_VELOCITY];
}

fn go(i: u32) {
    let by = change(i);
    let v = step_start[i * SLOTS + START_VELOCITY];
    position[i] = step_start[i * SLOTS] + vec4f(H * world.dt * v.xyz + by.curve, 0.0);
    velocity[i] = v + vec4f(by.velocity, 0.0);
}
