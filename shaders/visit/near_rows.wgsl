// What the `near` visits share: the rows of cells around me. A row is contiguous in the grid, but for the seam of the
// fold: there it is in parts, of which the middle one is on my side.
@group(1) @binding(2) var<storage, read_write> acceleration: array<vec4f>;
@group(1) @binding(4) var<storage, read_write> alarm: array<atomic<u32>>; // steps done, id, id of one with too many around
@group(2) @binding(1) var<storage, read> starts: array<u32>;

// Candidates of one search, at most: lavapipe ends an invocation's loops after 65 535 turns, without a word.
const MOST: u32 = 240000u;
const PARTS: u32 = 3u;
const MIDDLE: u32 = 1u;

// My cell, how far I look, the first row (y and z) and how many rows and cells; and for each part of a row its cells
// lower ≤ x < upper: those below the seam, the middle, those above the seam.
struct Around { cell: vec3u, reach: vec3u, first: vec3u, span: vec3u, lower: vec3u, upper: vec3u }

// A cell is a little wider than the range, so that rounding does not move a neighbour two cells away. Far from the
// corner rounding is more than that little, and two cells are looked at, or four.
fn reach(x: vec3f) -> vec3u {
    let d = abs(away(x));
    return select(select(vec3u(1u), vec3u(2u), d > vec3f(8192.0)), vec3u(4u), d > vec3f(2097152.0));
}

// Where an axis has fewer cells than I look at, each is looked at once.
fn around(x: vec3f) -> Around {
    let n = grid.cells;
    let r = reach(x);
    let c = cell(x);
    let span = min(2u * r + 1u, n);
    let first = select(c + n - min(r, n), c - r, c >= r) % n;
    if span.x == n.x { return Around(c, r, first, span, vec3u(0u), vec3u(0u, n.x, 0u)); }
    let low = i32(c.x) - i32(r.x);
    let high = c.x + r.x + 1u;
    let lower = vec3u(u32(min(low, 0) + i32(n.x)), u32(max(low, 0)), 0u);
    return Around(c, r, first, span, lower, vec3u(n.x, min(high, n.x), max(high, n.x) - n.x));
}

// The first cell of a row.
fn row(first: vec3u, z: u32, y: u32) -> u32 {
    let n = grid.cells;
    let c = first + vec3u(0u, y, z);
    let f = select(c, c - n, c >= n);
    return n.x * (f.y + n.y * f.z);
}

// Whether a row lies behind the seam: only there can another image be nearer.
fn behind(a: Around, z: u32, y: u32) -> bool {
    let other = (a.first > a.cell) != (a.first + vec3u(0u, y, z) >= grid.cells);
    return other.y || other.z;
}

// Whether a period has so few cells that both sides of the seam are in one part.
fn few(span: vec3u) -> bool { return any((span == grid.cells) & (world.period > vec3f())); }

fn in_range(r: vec3f) -> bool { return r.x * r.x + r.y * r.y + r.z * r.z < grid.range * grid.range; }

// Each of a pair holds half of its potential energy.
fn deliver(me: Particle, sum: Sum) {
    acceleration[me.index] += vec4f(1.0, 1.0, 1.0, 0.5) * finish(me, sum);
}
