// What the `near` visits share: the rows of cells around me. A row is contiguous in the cell list, but for the seam of the
// fold: there it is in parts, of which the middle one is on my side.
@group(1) @binding(4) var<storage, read_write> alarm: array<atomic<u32>>; // steps done, id, id of one with too many around

// Candidates of one search, at most: lavapipe ends an invocation's loops after 65 535 iterations silently.
override MOST: u32 = 240000u;
// What a stretch costs beside its candidates, in candidates: the iterations of the loops around it, and one that is not full.
const STRETCH: u32 = 16u;

// My cell, the reach of the search, and the numbers of rows and cells in it.
struct Around { cell: vec3u, reach: vec3u, span: vec3u }
// Some neighbouring slots, and what to add to the way to particles there: a period, where they lie behind the seam.
struct Stretch { start: u32, end: u32, shift: vec3f }

// A cell is a little wider than the range, so that rounding does not move a neighbour two cells away. Far from the
// corner rounding is more than that little, and two cells are looked at, or four.
fn reach(x: vec3f) -> vec3u {
    let d = abs(away(x)) / vec3f(grid.fine);
    return grid.fine * select(select(vec3u(1u), vec3u(2u), d > vec3f(8192.0)), vec3u(4u), d > vec3f(2097152.0));
}

fn around(x: vec3f) -> Around { return cube(cell(x), reach(x)); }

// If an axis has fewer cells than the search covers, each is visited once.
fn cube(cell: vec3u, reach: vec3u) -> Around {
    let r = min(reach, grid.cells);
    return Around(cell, r, min(2u * r + 1u, grid.cells));
}

// Rows along z of all lists of cells.
fn deep(a: Around) -> u32 { return a.span.z * LAYERS; }

// Part 0, 1 or 2 of the row y, z among those around me, for a particle in a cell from `low` to `high`, which is mine or close to it.
// Rows from z = span.z on are those of the second list.
fn stretch(a: Around, low: u32, high: u32, z: u32, y: u32, part: u32) -> Stretch {
    let n = vec3i(grid.cells);
    let r = vec3i(a.reach);
    let second = z >= a.span.z;
    let c = vec3i(i32(low), i32(a.cell.y + y), i32(a.cell.z + z - select(0u, a.span.z, second))) - r;
    let row = n.x * (wrap(c.y, n.y) + n.y * (wrap(c.z, n.z) + select(0, n.z, second)));
    // If the whole row is searched there is one part.
    let whole = a.span.x == grid.cells.x && 2 * r.x >= n.x;
    let top = i32(high) + r.x + 1;
    var first = select(max(c.x, 0), 0, whole);
    var last = select(min(top, n.x), n.x, whole);
    if part == 0u {
        first = min(c.x, 0) + n.x;
        last = select(n.x, 0, whole);
    }
    if part == 2u {
        first = 0;
        last = select(max(top, n.x) - n.x, 0, whole);
    }
    let turns = vec3i(i32(part) - 1, turn(c.y, n.y), turn(c.z, n.z));
    if first >= last { return Stretch(); }
    return Stretch(starts[row + first], starts[row + last], vec3f(turns) * world.period);
}

// Looks go no further than once round.
fn wrap(c: i32, n: i32) -> i32 { return c - n * turn(c, n); }
fn turn(c: i32, n: i32) -> i32 { return i32(c >= n) - i32(c < 0); }

// Whether a row reaches over the seam.
fn seam(a: Around) -> bool { return a.cell.x < a.reach.x || a.cell.x + a.reach.x >= grid.cells.x; }

// The vector to a neighbour. Where a period has so few cells that both sides of the seam coincide, any image may be the nearest.
override NARROW: bool = false;

fn way(me: vec3f, you: vec3f, shift: vec3f) -> vec3f {
    if NARROW { return shortest(you - me); }
    if PERIODIC { return you - me + shift; }
    return you - me;
}

fn in_range(r: vec3f) -> bool { return r.x * r.x + r.y * r.y + r.z * r.z < grid.range * grid.range; }
