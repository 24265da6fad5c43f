// Each workgroup scans a tile, from the sum of all tiles before it on (reduce-then-scan; Dotsenko et al. 2008).
@group(2) @binding(1) var<storage, read> sums: array<u32>;

@compute @workgroup_size(WORKGROUP)
fn scan_blocks(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let block = folded(group, groups);
    scan_tile(block * TILE, lane, sums[block]);
}
