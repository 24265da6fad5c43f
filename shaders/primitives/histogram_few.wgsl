// counts[key] += 1 for each key, where bins are few and contended: each workgroup counts a block of
// keys in its own memory first. Keys beyond the last bin are counted behind it.
struct Extent { unused_word: u32, elements: u32, bins: u32 }

@group(1) @binding(0) var<storage, read> keys: array<u32>;
@group(1) @binding(1) var<storage, read_write> counts: array<atomic<u32>>;
@group(2) @binding(0) var<uniform> extent: Extent;

const WORKGROUP: u32 = 256u;
const BLOCK: u32 = 8192u;
// Bins that fit, with the one behind the last.
const MOST: u32 = 2048u;

var<workgroup> own: array<atomic<u32>, MOST>;

@compute @workgroup_size(WORKGROUP)
fn histogram_few(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let first = folded(group, groups) * BLOCK;
    for (var bin = lane; bin <= extent.bins; bin += WORKGROUP) { atomicStore(&own[bin], 0u); }
    workgroupBarrier();
    let end = min(first + BLOCK, extent.elements);
    for (var i = first + lane; i < end; i += WORKGROUP) { atomicAdd(&own[min(keys[i], extent.bins)], 1u); }
    workgroupBarrier();
    for (var bin = lane; bin <= extent.bins; bin += WORKGROUP) {
        let count = atomicLoad(&own[bin]);
        if count > 0u { atomicAdd(&counts[bin], count); }
    }
}
