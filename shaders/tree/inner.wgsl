// Node n combines its children 2 n and 2 n + 1. The last node of a level may have only one.
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn inner(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let j = folded(group, groups) * WORKGROUP + lane;
    if j < nodes_of(level.above) {
        let n = level.first + j;
        var node = known(2u * n);
        if 2u * j + 1u < nodes_of(level.above - 1u) { node = together(node, known(2u * n + 1u)); }
        keep(n, node);
    }
}
