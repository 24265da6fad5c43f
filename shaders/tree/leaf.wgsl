// Leaf j combines the bodies from LEAF j on.
@group(2) @binding(6) var<storage, read> tree_body: array<vec4f>;

const WORKGROUP: u32 = 64u;

// One body: a node without an extent.
fn body(k: u32) -> Node {
    let b = tree_body[k];
    return Node(b.w, b.xyz, vec3f(), vec3f(), b.xyz, b.xyz);
}

@compute @workgroup_size(WORKGROUP)
fn leaf(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let j = folded(group, groups) * WORKGROUP + lane;
    if j < nodes_of(0u) {
        let first = j * LEAF;
        let end = min(first + LEAF, world.count);
        var node = body(first);
        for (var k = first + 1u; k < end; k++) { node = together(node, body(k)); }
        keep(level.first + j, node);
    }
}
