// Whose ball is the nearest in each pixel; of several at one depth the one with the lowest id.
@group(3) @binding(3) var<storage, read> front: array<u32>;
@group(3) @binding(4) var<storage, read_write> owner: array<atomic<u32>>;

@compute @workgroup_size(WORKGROUP)
fn claim(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let p = projected[i];
        if p.w > 0.0 {
            let rows = band(p, group.z);
            for (var y = rows.low.y; y < rows.high.y; y += 1) {
                for (var x = rows.low.x; x < rows.high.x; x += 1) {
                    if touches(p, x, y) && front[pixel(x, y)] == key(p.z) { atomicMin(&owner[pixel(x, y)], i); }
                }
            }
        }
    }
}
