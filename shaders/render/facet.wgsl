// Facets in the picture: triangles by their barycentric coordinates, lines by the distance from them.
@group(1) @binding(4) var<storage, read> facet: array<u32>;   // three ids; of a line the third is NONE
@group(1) @binding(10) var<storage, read> vertex: array<vec4f>; // pixels right and down, flat depth, 1 if seen; normal, 0

const WORKGROUP: u32 = 64u;
// Neighbours share their edge: a sample on it belongs to both, whatever is rounded.
const SLACK: f32 = 1e-4;
// Less than this is no area [pixels²].
const SLIVER: f32 = 1e-6;

struct Facet { ids: vec3u, line: bool, a: vec4f, b: vec4f, c: vec4f }

// The third corner of a line is its second.
fn facet_of(i: u32) -> Facet {
    var third = facet[3u * i + 2u];
    let line = third == NONE;
    if line { third = facet[3u * i + 1u]; }
    let ids = vec3u(facet[3u * i], facet[3u * i + 1u], third);
    return Facet(ids, line, vertex[2u * ids.x], vertex[2u * ids.y], vertex[2u * ids.z]);
}

fn turn(a: vec2f, b: vec2f) -> f32 { return a.x * b.y - a.y * b.x; }

// The parts of the three corners, and the distance of a point from the edge; below 0 it is outside.
fn parts(f: Facet, p: vec2f) -> vec4f {
    let a = f.a.xy - p;
    let b = f.b.xy - p;
    let c = f.c.xy - p;
    if f.line {
        let way = b - a;
        let s = clamp(dot(-a, way) / max(dot(way, way), SLIVER), 0.0, 1.0);
        return vec4f(1.0 - s, s, 0.0, frame.thread - length(a + s * way));
    }
    let area = turn(b - a, c - a);
    if abs(area) < SLIVER { return vec4f(-1.0); }
    let w = vec3f(turn(b, c), turn(c, a), turn(a, b)) / area;
    return vec4f(w, min(w.x, min(w.y, w.z)) + SLACK);
}

// A line is as thick as it is wide, and its front as near.
fn depth_of(f: Facet, w: vec4f) -> f32 {
    let bulge = select(0.0, frame.thread / frame.scale, f.line);
    return flat_depth(dot(w.xyz, vec3f(f.a.z, f.b.z, f.c.z))) - bulge;
}
