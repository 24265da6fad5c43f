// What a scan makes the number of particles before each that are due: 1 for one that is.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> due: array<u32>;
@group(2) @binding(0) var<storage, read_write> due_before: array<u32>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn count_due(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count { due_before[i] = due[i]; }
}
