// The upper words of keys, in the order sorted by the lower words.
@group(2) @binding(0) var<storage, read> tree_id: array<u32>;
@group(2) @binding(1) var<storage, read> tree_upper: array<u32>;
@group(2) @binding(2) var<storage, read_write> tree_key: array<u32>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn upper(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.capacity { tree_key[i] = tree_upper[tree_id[i]]; }
}
