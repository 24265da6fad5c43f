// A Runge–Kutta stage of a column, its slope y' just evaluated: add b times it to the sum, and go from the start of the step
// to where the next slope is wanted:  y ← y₀ + c y' dt,  of particles that are free and active.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> value: array<Value>;
@group(1) @binding(1) var<storage, read> rate: array<Value>;
@group(1) @binding(2) var<storage, read> start: array<Value>;
@group(1) @binding(3) var<storage, read_write> slope: array<Value>;

override ELEMENTS: u32 = 1u;
override SLOTS: u32 = 1u;
override WEIGHT: f32 = 1.0; // b
override FACTOR: f32 = 1.0; // c

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn stage(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < ELEMENTS && !is_held(i / SLOTS) && is_active(i / SLOTS) {
        slope[i] += WEIGHT * rate[i];
        value[i] = own(value[i], start[i] + (FACTOR * world.dt) * rate[i]);
    }
}
