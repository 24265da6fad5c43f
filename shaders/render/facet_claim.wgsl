// Whose sample it is: of all facets that are as near as the nearest the one with the lowest number.
@group(3) @binding(12) var<storage, read> nearest: array<u32>;
@group(3) @binding(13) var<storage, read_write> holder: array<atomic<u32>>;

// Depths that so few of the numbers between them part are one: neighbours are equally near at their edge.
const SAME: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn claim(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane + FIRST;
    if i < END {
        let f = facet_of(i);
        if drawn(i, f) {
            let rows = band(f, group.z);
            for (var y = rows.low.y; y < rows.high.y; y += 1) {
                let ends = span(f, rows, y);
                for (var x = ends.x; x < ends.y; x += 1) {
                    let w = parts(f, sample(x, y));
                    let at = u32(y * columns() + x);
                    if w.w >= 0.0 && key(depth_of(f, w)) - nearest[at] <= SAME { atomicMin(&holder[at], i); }
                }
            }
        }
    }
}
