// One item out of many, by a fixed tree, so that every run gives the same bits: each invocation takes every 256th item of
// its workgroup's block, then halves are combined. A second file defines the item and the combination.
struct Extent { unused_word: u32, elements: u32, block: u32, neutral: u32 }

@group(1) @binding(0) var<storage, read> items: array<Item>;
@group(1) @binding(1) var<storage, read_write> results: array<Item>;
@group(2) @binding(0) var<uniform> extent: Extent;

const WORKGROUP: u32 = 256u;

var<workgroup> parts: array<Item, WORKGROUP>;

@compute @workgroup_size(WORKGROUP)
fn reduce(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let block = folded(group, groups);
    let first = block * extent.block;
    let end = end_of(first);
    var total = neutral(extent.neutral);
    for (var i = first + lane; i < end; i += WORKGROUP) { total = combine(total, items[i]); }
    for (var width = WORKGROUP; width > 1u; width /= 2u) {
        if lane < width { parts[lane] = total; }
        workgroupBarrier();
        let half = width / 2u;
        if lane < half { total = combine(total, parts[lane + half]); }
    }
    // Of nothing the result is neutral.
    if lane == 0u && (first < extent.elements || block == 0u) { results[block] = total; }
}
