// Counts the keys of each bin, and notes the order of arrival: ranks[i] = how many of its bin were there before i. Keys beyond
// the last bin share the one behind it.
struct Extent { unused_word: u32, elements: u32, bins: u32 }

@group(1) @binding(0) var<storage, read> keys: array<u32>;
@group(1) @binding(1) var<storage, read_write> starts: array<atomic<u32>>;
@group(2) @binding(0) var<uniform> extent: Extent;
@group(2) @binding(1) var<storage, read_write> ranks: array<u32>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn sort_count(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < extent.elements { ranks[i] = atomicAdd(&starts[min(keys[i], extent.bins)], 1u); }
}
