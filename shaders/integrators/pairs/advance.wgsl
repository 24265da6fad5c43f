// A column y is advanced by its rate y', at a kick or a drift:  y ← y + c y' dt,  of particles that are free and active.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> value: array<Value>;
@group(1) @binding(1) var<storage, read> rate: array<Value>;

override ELEMENTS: u32 = 1u;
override SLOTS: u32 = 1u;    // elements of each particle
override FACTOR: f32 = 1.0;  // c

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn advance(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < ELEMENTS && !is_held(i / SLOTS) && is_active(i / SLOTS) {
        value[i] = own(value[i], value[i] + (FACTOR * world.dt) * rate[i]);
    }
}
