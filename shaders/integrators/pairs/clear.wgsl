// Before the first law: the sum is zero.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> value: array<Value>;

override ELEMENTS: u32 = 1u;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn clear(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < ELEMENTS { value[i] = Value(); }
}
