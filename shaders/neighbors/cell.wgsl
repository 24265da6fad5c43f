// A uniform grid over all of space, folded onto a box of cells: cell c of an axis is kept as c modulo the cells of the
// axis. Along a periodic axis that is the period itself; elsewhere far cells share a slot, and particles found there fail
// the test of distance. So there is no edge, and no particle is outside.
// A range is `fine` cells, more of them along x, where cells are contiguous: so rows are cut closer to the particle.
struct Grid {
    unused_word: u32, low: vec3f, range: f32, per_cell: vec3f, first: u32, cells: vec3u, end: u32, only: u32, fine: vec3u,
}

@group(2) @binding(0) var<uniform> grid: Grid;

// The number of cell lists, one after the other: 2 where fixed particles come after all others.
override LAYERS: u32 = 1u;

// Beyond this number of cells all are one: there, f32 does not resolve positions that are a cell apart.
const FARTHEST: f32 = 536870912.0; // 2²⁹

// Whether the box changes: its cells change with it.
override ELASTIC: bool = false;

// The distance from the corner of the cell list in cells, along each axis.
fn away(x: vec3f) -> vec3f {
    if ELASTIC { return (x - world.low) * (vec3f(grid.cells) * world.frequency); }
    return (x - grid.low) * grid.per_cell;
}

fn fold(c: i32, cells: u32) -> u32 {
    // A multiple of the cells that makes every c positive.
    let whole = (u32(FARTHEST) / cells + 1u) * cells;
    return (bitcast<u32>(c) + whole) % cells;
}

// Its image in the box, where it is on the way outside: on my side of the seam no particle is then nearer elsewhere.
fn wrapped(x: vec3f) -> vec3f {
    if !PERIODIC { return x; }
    let inside = ((x >= world.low) & (x < world.high)) | (world.period <= vec3f());
    let y = select(x - world.period * floor((x - world.low) * world.frequency), x, inside);
    return select(y, world.low, !inside & ((y < world.low) | (y >= world.high)));
}

// The cell of a wrapped position, folded. A position that is NaN is in some cell, too: the watch kernel detects it.
fn cell(x: vec3f) -> vec3u {
    let last = select(vec3f(FARTHEST), vec3f(grid.cells) - 1.0, world.period > vec3f());
    let c = vec3i(clamp(floor(away(x)), vec3f(-FARTHEST), last));
    return vec3u(fold(c.x, grid.cells.x), fold(c.y, grid.cells.y), fold(c.z, grid.cells.z));
}

fn key(c: vec3u) -> u32 { return c.x + grid.cells.x * (c.y + grid.cells.y * c.z); }
