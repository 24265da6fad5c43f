// A workgroup sorts a tile by four bits, stably: each invocation counts its own four items in a column of its own, and a
// scan over the columns, digit by digit, says where each item goes (Satish, Harris, Garland 2009).
const WORKGROUP: u32 = 256u;
const EACH: u32 = 4u;
const TILE: u32 = 1024u;

// An item: its digit above, its place in the tile as it was loaded in the lower half.
var<workgroup> tile: array<u32, TILE>;
// The counts of a digit in the lower half, and of that digit + 8 in the upper: eight rows, a column for each invocation.
var<workgroup> columns: array<u32, 2048>;
var<workgroup> totals: array<u32, 512>;

fn column(item: u32, shift: u32, lane: u32) -> u32 { return ((item >> shift) & 7u) * WORKGROUP + lane; }
fn half(item: u32, shift: u32) -> u32 { return ((item >> (shift + 3u)) & 1u) * 16u; }

// The item, and how many of the same digit this invocation had before it.
fn count(at: u32, shift: u32, lane: u32) -> vec2u {
    let item = tile[at];
    let before = columns[column(item, shift, lane)];
    columns[column(item, shift, lane)] = before + (1u << half(item, shift));
    return vec2u(item, (before >> half(item, shift)) & 0xffffu);
}

fn put(counted: vec2u, shift: u32, lane: u32) {
    let first = (columns[column(counted.x, shift, lane)] >> half(counted.x, shift)) & 0xffffu;
    tile[first + counted.y] = counted.x;
}

// Sorts the tile by the four bits from `shift` on.
fn split(shift: u32, lane: u32) {
    for (var row = 0u; row < 8u; row++) { columns[row * WORKGROUP + lane] = 0u; }
    let a = count(4u * lane, shift, lane);
    let b = count(4u * lane + 1u, shift, lane);
    let c = count(4u * lane + 2u, shift, lane);
    let d = count(4u * lane + 3u, shift, lane);
    workgroupBarrier();
    var own = 0u;
    for (var k = 0u; k < 8u; k++) { own += columns[8u * lane + k]; }
    // Over all invocations (Hillis, Steele 1986), both halves at once: no sum is above 1024.
    var total = own;
    var side = 0u;
    for (var reach = 1u; reach < WORKGROUP; reach *= 2u) {
        totals[side + lane] = total;
        workgroupBarrier();
        if lane >= reach { total += totals[side + lane - reach]; }
        side = WORKGROUP - side;
    }
    totals[side + lane] = total;
    workgroupBarrier();
    // Digits from 8 on come after all below 8.
    var before = total - own + (totals[side + WORKGROUP - 1u] << 16u);
    for (var k = 0u; k < 8u; k++) {
        let counted = columns[8u * lane + k];
        columns[8u * lane + k] = before;
        before += counted;
    }
    workgroupBarrier();
    put(a, shift, lane);
    put(b, shift, lane);
    put(c, shift, lane);
    put(d, shift, lane);
    workgroupBarrier();
}
