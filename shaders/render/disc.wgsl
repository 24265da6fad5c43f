// The pixels of a ball's disc. Each layer of the dispatch has rows of its own, so that no invocation loops too long.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(2) var<storage, read> projected: array<vec4f>; // pixels right and down, depth of its front, radius

override ROWS: i32 = 64;

const WORKGROUP: u32 = 64u;

fn band(p: vec4f, layer: u32) -> Box {
    let all = box(p.xy, p.w + 0.5);
    let low = min(all.low.y + i32(layer) * ROWS, all.high.y);
    return Box(vec2i(all.low.x, low), vec2i(all.high.x, min(low + ROWS, all.high.y)));
}

// Half a pixel beyond the edge a pixel is still touched.
fn touches(p: vec4f, x: i32, y: i32) -> bool { return distance(middle(x, y), p.xy) < p.w + 0.5; }
