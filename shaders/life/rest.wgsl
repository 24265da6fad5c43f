// A particle that is not active has no acceleration, and no share of the potential energy.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> acceleration: array<vec4f>; // xyz, potential

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn rest(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && !is_active(i) { acceleration[i] = vec4f(); }
}
