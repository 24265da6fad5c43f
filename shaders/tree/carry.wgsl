// Positions and masses in the order of the curve.
@group(2) @binding(0) var<storage, read> tree_id: array<u32>;
@group(2) @binding(1) var<storage, read_write> tree_body: array<vec4f>; // xyz, mass

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn carry(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let k = folded(group, groups) * WORKGROUP + lane;
    if k < world.count { tree_body[k] = position[tree_id[k]]; }
}
