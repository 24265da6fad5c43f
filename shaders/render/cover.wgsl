// The nearest ball in each pixel:  front = min depth (the z-buffer, Catmull 1974)
@group(3) @binding(3) var<storage, read_write> front: array<atomic<u32>>;

@compute @workgroup_size(WORKGROUP)
fn cover(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let p = projected[i];
        if p.w > 0.0 {
            let rows = band(p, group.z);
            for (var y = rows.low.y; y < rows.high.y; y += 1) {
                for (var x = rows.low.x; x < rows.high.x; x += 1) {
                    if touches(p, x, y) { atomicMin(&front[pixel(x, y)], key(p.z)); }
                }
            }
        }
    }
}
