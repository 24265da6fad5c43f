// The sum of each tile.
struct Extent { unused_word: u32, elements: u32 }

@group(1) @binding(0) var<storage, read> items: array<u32>;
@group(2) @binding(0) var<uniform> extent: Extent;
@group(2) @binding(1) var<storage, read_write> sums: array<u32>;

const WORKGROUP: u32 = 256u;
const EACH: u32 = 8u;
const TILE: u32 = 2048u;

var<workgroup> totals: array<u32, WORKGROUP>;

@compute @workgroup_size(WORKGROUP)
fn scan_sums(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let block = folded(group, groups);
    var total = 0u;
    for (var k = 0u; k < EACH; k++) {
        let i = block * TILE + k * WORKGROUP + lane;
        if i < extent.elements { total += items[i]; }
    }
    for (var width = WORKGROUP; width > 1u; width /= 2u) {
        if lane < width { totals[lane] = total; }
        workgroupBarrier();
        let half = width / 2u;
        if lane < half { total += totals[lane + half]; }
    }
    if lane == 0u && block * TILE < extent.elements { sums[block] = total; }
}
