// Whose front is the nearest in each pixel; of several at one depth that of the one with the lowest id.
@group(3) @binding(16) var<storage, read> crest: array<u32>;
@group(3) @binding(19) var<storage, read_write> source: array<atomic<u32>>;

@compute @workgroup_size(WORKGROUP)
fn claim(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let p = projected[i];
        if p.w > 0.0 {
            let rows = band(p, group.z);
            for (var y = rows.low.y; y < rows.high.y; y += 1) {
                for (var x = rows.low.x; x < rows.high.x; x += 1) {
                    let nearest = key(depth_at(p, bulge(p, x, y))) == crest[pixel(x, y)];
                    if nearest && touches(p, x, y) { atomicMin(&source[pixel(x, y)], i); }
                }
            }
        }
    }
}
