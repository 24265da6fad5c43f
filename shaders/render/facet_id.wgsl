// The facet of each sample: of all facets that are as near as the nearest the one with the lowest number.
@group(3) @binding(12) var<storage, read> nearest: array<u32>;
@group(3) @binding(13) var<storage, read_write> holder: array<atomic<u32>>;

// Depths that so few of the numbers between them part are one: neighbours are equally near at their edge.
const SAME: u32 = 64u;

fn mark(i: u32, at: u32, depth: u32) {
    if depth - nearest[at] <= SAME { atomicMin(&holder[at], i); }
}
