// The samples of the picture that each facet touches, some rows in each layer of a dispatch, each passed to
// fn mark(i: u32, at: u32, depth: u32).
@group(1) @binding(7) var<storage, read> broken_facet: array<u32>;

override FIRST: u32 = 0u;
override END: u32 = 1u;
override ROWS: i32 = 64;

fn columns() -> i32 { return i32(frame.width * frame.fine); }

// The middle of a sample [pixels].
fn sample(x: i32, y: i32) -> vec2f { return middle(x, y) / f32(frame.fine); }

fn drawn(i: u32, f: Facet) -> bool { return broken_facet[i] == 0u && f.a.w * f.b.w * f.c.w > 0.0; }

fn band(f: Facet, layer: u32) -> Box {
    let fine = f32(frame.fine);
    let size = vec2f(f32(columns()), f32(frame.height) * fine);
    let reach = select(0.0, frame.thread, f.line);
    let low = vec2i(clamp(floor((min(f.a.xy, min(f.b.xy, f.c.xy)) - reach) * fine), vec2f(0.0), size));
    let high = vec2i(clamp(ceil((max(f.a.xy, max(f.b.xy, f.c.xy)) + reach) * fine), vec2f(0.0), size));
    let first = min(low.y + i32(layer) * ROWS, high.y);
    return Box(vec2i(low.x, first), vec2i(high.x, min(first + ROWS, high.y)));
}

// In a row: of a triangle all columns, of a line those within a strip along it.
fn span(f: Facet, rows: Box, y: i32) -> vec2i {
    let way = f.b.xy - f.a.xy;
    if !f.line || way.y == 0.0 { return vec2i(rows.low.x, rows.high.x); }
    let at = f.a.x + (sample(0, y).y - f.a.y) * way.x / way.y;
    let half = frame.thread * length(way) / abs(way.y);
    let low = clamp(floor((at - half) * f32(frame.fine)), f32(rows.low.x), f32(rows.high.x));
    return vec2i(vec2f(low, clamp(ceil((at + half) * f32(frame.fine)), low, f32(rows.high.x))));
}

@compute @workgroup_size(WORKGROUP)
fn samples(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane + FIRST;
    if i < END {
        let f = facet_of(i);
        if drawn(i, f) {
            let rows = band(f, group.z);
            for (var y = rows.low.y; y < rows.high.y; y += 1) {
                let ends = span(f, rows, y);
                for (var x = ends.x; x < ends.y; x += 1) {
                    let w = parts(f, sample(x, y));
                    if w.w >= 0.0 { mark(i, u32(y * columns() + x), key(depth_of(f, w))); }
                }
            }
        }
    }
}
