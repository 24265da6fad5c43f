// Copies pairs: before an odd number of passes between two buffers.
struct Extent { unused_word: u32, elements: u32 }

@group(1) @binding(0) var<storage, read> keys: array<u32>;
@group(1) @binding(1) var<storage, read> values: array<u32>;
@group(1) @binding(2) var<storage, read_write> sorted_keys: array<u32>;
@group(1) @binding(3) var<storage, read_write> sorted_values: array<u32>;
@group(2) @binding(0) var<uniform> extent: Extent;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn radix_copy(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < extent.elements {
        sorted_keys[i] = keys[i];
        sorted_values[i] = values[i];
    }
}
