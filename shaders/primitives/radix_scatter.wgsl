// Each workgroup scatters its block to the sorted positions, tile by tile: sorted by the digit in workgroup memory first, so that
// neighbours write to neighbours.
struct Extent { unused_word: u32, elements: u32, block: u32, blocks: u32, shift: u32, mask: u32 }

@group(1) @binding(0) var<storage, read> keys: array<u32>;
@group(1) @binding(1) var<storage, read> values: array<u32>;
@group(1) @binding(2) var<storage, read_write> sorted_keys: array<u32>;
@group(1) @binding(3) var<storage, read_write> sorted_values: array<u32>;
@group(2) @binding(0) var<uniform> extent: Extent;
@group(2) @binding(1) var<storage, read> table: array<u32>;

// The destination of the next key of each digit.
var<workgroup> nexts: array<u32, WORKGROUP>;

fn digit(at: u32) -> u32 { return tile[at] >> 16u; }

@compute @workgroup_size(WORKGROUP)
fn radix_scatter(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let block = folded(group, groups);
    let first = block * extent.block;
    let end = min(first + extent.block, extent.elements);
    if lane <= extent.mask { nexts[lane] = table[lane * extent.blocks + block]; }
    for (var start = first; start < end; start += TILE) {
        for (var k = 0u; k < EACH; k++) {
            let at = k * WORKGROUP + lane;
            // Data after the last key stays after it.
            var own = 255u;
            if start + at < end { own = (keys[start + at] >> extent.shift) & extent.mask; }
            tile[at] = (own << 16u) | at;
        }
        workgroupBarrier();
        for (var shift = 16u; shift <= 20u; shift += 4u) { split(shift, lane); }
        // The start of each digit in the tile: the columns are no longer needed.
        for (var at = lane; at < TILE; at += WORKGROUP) {
            if at == 0u || digit(at - 1u) != digit(at) { columns[digit(at)] = at; }
        }
        workgroupBarrier();
        for (var k = 0u; k < EACH; k++) {
            let at = k * WORKGROUP + lane;
            let old = start + (tile[at] & 0xffffu);
            if old < end {
                let to = nexts[digit(at)] + at - columns[digit(at)];
                sorted_keys[to] = keys[old];
                sorted_values[to] = values[old];
            }
        }
        workgroupBarrier();
        for (var at = lane; at < TILE; at += WORKGROUP) {
            if at + 1u == TILE || digit(at + 1u) != digit(at) { nexts[digit(at)] += at + 1u - columns[digit(at)]; }
        }
        workgroupBarrier();
    }
}
