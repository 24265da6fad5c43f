// A Runge–Kutta step of a column ends, its last slope just evaluated:  y ← y₀ + dt Σ bᵢ y'ᵢ,  of particles that are free and active.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> value: array<Value>;
@group(1) @binding(1) var<storage, read> rate: array<Value>;
@group(1) @binding(2) var<storage, read> start: array<Value>;
@group(1) @binding(3) var<storage, read> slope: array<Value>;

override ELEMENTS: u32 = 1u;
override SLOTS: u32 = 1u;
override WEIGHT: f32 = 1.0; // b of the last stage

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn finish(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < ELEMENTS && !is_held(i / SLOTS) && is_active(i / SLOTS) {
        value[i] = own(value[i], start[i] + world.dt * (slope[i] + WEIGHT * rate[i]));
    }
}
