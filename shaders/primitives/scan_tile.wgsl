// A workgroup scans what fits into its memory, for `scan_line` and `scan_blocks`: serially in each invocation, then over the
// invocations' totals (Hillis, Steele 1986).
struct Extent { unused_word: u32, elements: u32 }

@group(1) @binding(0) var<storage, read_write> items: array<u32>;
@group(2) @binding(0) var<uniform> extent: Extent;

const WORKGROUP: u32 = 256u;
const EACH: u32 = 8u;
const TILE: u32 = 2048u;

// A gap after each invocation's items, so that neighbours use different banks.
var<workgroup> tile: array<u32, 2304>;
var<workgroup> totals: array<u32, 512>;

fn place(i: u32) -> u32 { return i + i / EACH; }

// Puts the exclusive sums of items[start ..] in their place, each with `before` added; gives what stands before the next tile.
fn scan_tile(start: u32, lane: u32, before: u32) -> u32 {
    // Neighbours load neighbours.
    for (var at = lane; at < TILE; at += WORKGROUP) {
        var item = 0u;
        if start + at < extent.elements { item = items[start + at]; }
        tile[place(at)] = item;
    }
    workgroupBarrier();
    var own = 0u;
    for (var k = 0u; k < EACH; k++) {
        let at = place(lane * EACH + k);
        let item = tile[at];
        tile[at] = own;
        own += item;
    }
    var total = own;
    var half = 0u;
    for (var reach = 1u; reach < WORKGROUP; reach *= 2u) {
        totals[half + lane] = total;
        workgroupBarrier();
        if lane >= reach { total += totals[half + lane - reach]; }
        half = WORKGROUP - half;
    }
    totals[half + lane] = total;
    let first = before + total - own;
    for (var k = 0u; k < EACH; k++) { tile[place(lane * EACH + k)] += first; }
    workgroupBarrier();
    let next = before + totals[half + WORKGROUP - 1u];
    for (var k = 0u; k < EACH; k++) {
        let at = k * WORKGROUP + lane;
        if start + at < extent.elements { items[start + at] = tile[place(at)]; }
    }
    // The next tile may overwrite this one.
    workgroupBarrier();
    return next;
}
