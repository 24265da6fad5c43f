// Whose drop is seen in each pixel: of all that are as near as the nearest the one with the lowest id.
@group(3) @binding(16) var<storage, read> crest: array<u32>;
@group(3) @binding(19) var<storage, read_write> source: array<atomic<u32>>;

// Depths that so few of the numbers between them part are one: the last places may differ from those of another shader.
const SAME: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn sources(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let p = projected[i];
        if p.w > 0.0 {
            let rows = band(p, group.z);
            for (var y = rows.low.y; y < rows.high.y; y += 1) {
                for (var x = rows.low.x; x < rows.high.x; x += 1) {
                    let at = pixel(x, y);
                    let depth = key(depth_at(p, bulge(p, x, y)));
                    // Beyond the last key there is none: who is nowhere nearest has no pixel.
                    if touches(p, x, y) && depth <= crest[at] + SAME { atomicMin(&source[at], i); }
                }
            }
        }
    }
}
