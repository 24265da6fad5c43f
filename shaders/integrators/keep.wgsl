// Before a measurement evaluates the forces again: save those that the next step will use.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> acceleration: array<vec4f>;
@group(1) @binding(1) var<storage, read_write> kept_acceleration: array<vec4f>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn keep(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count { kept_acceleration[i] = acceleration[i]; }
}
