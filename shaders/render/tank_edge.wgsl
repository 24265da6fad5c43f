// The edges of tanks: thin lines, by the distance from them.
struct Edge { a: vec4f, b: vec4f } // two ends: pixels right and down, flat depth, 0

@group(1) @binding(13) var<storage, read> edge: array<Edge>;

// The parts of a pixel that lines cover behind a depth, and in front of it; behind `hidden` there are none.
fn edges(place: vec2f, depth: f32, hidden: u32) -> vec2f {
    var cover = vec2f();
    for (var k = 0u; k < frame.edges; k += 1u) {
        let one = edge[k];
        let off = place - one.a.xy;
        let way = one.b.xy - one.a.xy;
        let s = clamp(dot(off, way) / max(dot(way, way), 1e-6), 0.0, 1.0);
        let part = clamp(frame.wire + 0.5 - length(off - s * way), 0.0, 1.0);
        let there = flat_depth(mix(one.a.z, one.b.z, s));
        if key(there) < hidden { cover = max(cover, select(vec2f(part, 0.0), vec2f(0.0, part), there < depth)); }
    }
    return cover;
}
