// Before and after a measurement: rates that the next step will use are saved and restored.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> from_field: array<Value>;
@group(1) @binding(1) var<storage, read_write> to_field: array<Value>;

override ELEMENTS: u32 = 1u;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn copy(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < ELEMENTS { to_field[i] = from_field[i]; }
}
