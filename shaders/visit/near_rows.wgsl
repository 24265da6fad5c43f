// What the `near` visits share: the rows of cells around me. A row is contiguous in the grid; at the seam of the fold it
// is in two parts: cells below the seam, and above it.
@group(1) @binding(2) var<storage, read_write> acceleration: array<vec4f>;
@group(1) @binding(4) var<storage, read_write> alarm: array<atomic<u32>>; // steps done, id, id of one with too many around
@group(2) @binding(1) var<storage, read> starts: array<u32>;

// Candidates of one target, at most: four in a turn of a loop, and lavapipe ends an invocation's loops after 65 535.
const MOST: u32 = 240000u;
const PARTS: u32 = 3u;

struct Around { cell: vec3u, reach: vec3u, first: vec3u, span: vec3u }

// A cell is a little wider than the range, so that rounding does not move a neighbour two cells away. Far from the
// corner rounding is more than that little, and two cells are looked at, or four.
fn reach(x: vec3f) -> vec3u {
    let d = abs(away(x));
    return select(select(vec3u(1u), vec3u(2u), d > vec3f(8192.0)), vec3u(4u), d > vec3f(2097152.0));
}

// Where an axis has fewer cells than that, each is looked at once.
fn around(x: vec3f) -> Around {
    let r = reach(x);
    let c = cell(x);
    let span = min(2u * r + 1u, grid.cells);
    return Around(c, r, (c + grid.cells - min(r, grid.cells)) % grid.cells, span);
}

// The slots of one part of a row: before the seam, in the middle, behind the seam.
fn slots_of(a: Around, z: u32, y: u32, part: u32) -> vec2u {
    let n = grid.cells.x;
    let row = n * ((a.first.y + y) % grid.cells.y + grid.cells.y * ((a.first.z + z) % grid.cells.z));
    let low = i32(a.cell.x) - i32(a.reach.x);
    let high = i32(a.cell.x) + i32(a.reach.x) + 1;
    var lower = 0u;
    var upper = n;
    if a.span.x < n {
        lower = u32(max(low, 0));
        upper = u32(min(high, i32(n)));
        if part == 0u { lower = u32(min(low, 0) + i32(n)); upper = n; }
        if part == 2u { lower = 0u; upper = u32(max(high, i32(n)) - i32(n)); }
    } else if part != 1u {
        upper = 0u;
    }
    return vec2u(starts[row + lower], starts[row + upper]);
}

// Whether a row has a part before or behind the seam.
fn parts(a: Around) -> vec2u {
    if a.span.x == grid.cells.x { return vec2u(1u, 2u); }
    return vec2u(select(1u, 0u, a.cell.x < a.reach.x), select(2u, 3u, a.cell.x + a.reach.x >= grid.cells.x));
}

fn in_range(r: vec3f) -> bool { return r.x * r.x + r.y * r.y + r.z * r.z < grid.range * grid.range; }

// Each of a pair holds half of its potential energy.
fn deliver(me: Particle, sum: Sum) {
    acceleration[me.index] += vec4f(1.0, 1.0, 1.0, 0.5) * finish(me, sum);
}
