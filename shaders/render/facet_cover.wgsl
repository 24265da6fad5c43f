// The nearest facet at each sample:  nearest = min depth (the z-buffer, Catmull 1974)
@group(3) @binding(12) var<storage, read_write> nearest: array<atomic<u32>>;

@compute @workgroup_size(WORKGROUP)
fn cover(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane + FIRST;
    if i < END {
        let f = facet_of(i);
        if drawn(i, f) {
            let rows = band(f, group.z);
            for (var y = rows.low.y; y < rows.high.y; y += 1) {
                let ends = span(f, rows, y);
                for (var x = ends.x; x < ends.y; x += 1) {
                    let w = parts(f, sample(x, y));
                    if w.w >= 0.0 { atomicMin(&nearest[u32(y * columns() + x)], key(depth_of(f, w))); }
                }
            }
        }
    }
}
