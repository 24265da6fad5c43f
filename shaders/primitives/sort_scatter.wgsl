// Each element goes to its bin, in the order in which they were counted.
struct Extent { unused_word: u32, elements: u32, bins: u32 }

@group(1) @binding(0) var<storage, read> keys: array<u32>;
@group(1) @binding(1) var<storage, read> starts: array<u32>;
@group(2) @binding(0) var<uniform> extent: Extent;
@group(2) @binding(1) var<storage, read> ranks: array<u32>;
@group(2) @binding(2) var<storage, read_write> arrivals: array<u32>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn sort_scatter(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < extent.elements { arrivals[starts[min(keys[i], extent.bins)] + ranks[i]] = i; }
}
