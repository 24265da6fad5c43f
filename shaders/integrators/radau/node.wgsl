// The acceleration at a node gives the divided difference there; then on to the next node.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(5) var<storage, read> acceleration: array<vec4f>; // xyz, potential

override AT: u32 = 1u; // the node
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn radau_node(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i >= world.count { return; }
    // A step of no length learns nothing.
    if world.dt > 0.0 {
        let first = i * DIFFERENCES;
        var difference = (acceleration[i].xyz - step_start[i * SLOTS + START_ACCELERATION].xyz) / NODE[AT];
        for (var k = 1u; k < AT; k += 1u) { difference = (difference - acceleration_differences[first + k - 1u].xyz) / (NODE[AT] - NODE[k]); }
        if AT == DIFFERENCES { step_start[i * SLOTS + BEFORE] = acceleration_differences[first + AT - 1u]; }
        acceleration_differences[first + AT - 1u] = vec4f(difference, 0.0);
    }
    go(i);
}
