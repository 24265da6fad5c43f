// The key of each body: the position of its cell along the Hilbert curve. No product is followed by a sum, which a compiler might
// contract, so that every device finds the same cells.
@group(2) @binding(0) var<storage, read> tree_cube: array<vec4f>;
@group(2) @binding(1) var<storage, read_write> tree_key: array<u32>;
@group(2) @binding(2) var<storage, read_write> tree_upper: array<u32>;
@group(2) @binding(3) var<storage, read_write> tree_id: array<u32>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn key(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i >= world.count && i < world.capacity {
        // Free rows come last.
        tree_upper[i] = 0xffffffffu;
        tree_key[i] = 0xffffffffu;
        tree_id[i] = i;
    }
    if i < world.count {
        let cube = tree_cube[0];
        // A position that is NaN is in some cell: the watch finds it.
        let cell = vec3u((position[i].xyz - cube.xyz) * cube.w);
        let words = hilbert(min(cell, vec3u(CELLS - 1u)));
        tree_upper[i] = words.x;
        tree_key[i] = words.y;
        tree_id[i] = i;
    }
}
