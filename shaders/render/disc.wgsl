// The pixels of every ball's disc, each passed to fn mark(i: u32, p: vec4f, x: i32, y: i32). Each layer of the dispatch
// has rows of its own, so that no invocation loops too long.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(2) var<storage, read> projected: array<vec4f>; // pixels right and down, depth of its front, radius

override ROWS: i32 = 64;
// Whether it is hidden particles that are passed.
override WALLS: bool = false;

const WORKGROUP: u32 = 64u;
const HIDDEN: f32 = -2.0;

fn band(p: vec4f, layer: u32) -> Box {
    let all = box(p.xy, p.w + 0.5);
    let low = min(all.low.y + i32(layer) * ROWS, all.high.y);
    return Box(vec2i(all.low.x, low), vec2i(all.high.x, min(low + ROWS, all.high.y)));
}

// Half a pixel beyond the edge a pixel is still touched.
fn touches(p: vec4f, x: i32, y: i32) -> bool { return distance(middle(x, y), p.xy) < p.w + 0.5; }

@compute @workgroup_size(WORKGROUP)
fn discs(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        var p = projected[i];
        if WALLS { p.w = HIDDEN - p.w; }
        if p.w > 0.0 {
            let rows = band(p, group.z);
            for (var y = rows.low.y; y < rows.high.y; y += 1) {
                for (var x = rows.low.x; x < rows.high.x; x += 1) {
                    if touches(p, x, y) { mark(i, p, x, y); }
                }
            }
        }
    }
}
