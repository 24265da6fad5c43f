// counts[key] += 1 for each key; keys beyond the last bin are counted behind it.
struct Extent { unused_word: u32, elements: u32, bins: u32 }

@group(1) @binding(0) var<storage, read> keys: array<u32>;
@group(1) @binding(1) var<storage, read_write> counts: array<atomic<u32>>;
@group(2) @binding(0) var<uniform> extent: Extent;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn histogram(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < extent.elements { atomicAdd(&counts[min(keys[i], extent.bins)], 1u); }
}
