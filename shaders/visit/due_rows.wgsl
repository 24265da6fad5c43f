// The number of particles that are due, and their rows in ascending order: from the sums of those before each.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> due: array<u32>;
@group(2) @binding(0) var<storage, read> due_before: array<u32>;
@group(2) @binding(1) var<storage, read_write> due_rows: array<u32>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn list_due(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && due[i] != 0u { due_rows[1u + due_before[i]] = i; }
    if i == world.count { due_rows[0] = due_before[i]; }
}
