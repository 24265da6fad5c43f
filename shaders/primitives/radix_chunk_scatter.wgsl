// Each invocation scatters its chunk to the sorted positions, key by key.
struct Extent { unused_word: u32, elements: u32, block: u32, blocks: u32, shift: u32, mask: u32 }

@group(1) @binding(0) var<storage, read> keys: array<u32>;
@group(1) @binding(1) var<storage, read> values: array<u32>;
@group(1) @binding(2) var<storage, read_write> sorted_keys: array<u32>;
@group(1) @binding(3) var<storage, read_write> sorted_values: array<u32>;
@group(2) @binding(0) var<uniform> extent: Extent;
@group(2) @binding(1) var<storage, read_write> table: array<u32>;

const WORKGROUP: u32 = 8u;

@compute @workgroup_size(WORKGROUP)
fn radix_chunk_scatter(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let chunk = folded(group, groups) * WORKGROUP + lane;
    let first = chunk * extent.block;
    let end = min(first + extent.block, extent.elements);
    for (var i = first; i < end; i++) {
        let key = keys[i];
        let next = ((key >> extent.shift) & extent.mask) * extent.blocks + chunk;
        let to = table[next];
        table[next] = to + 1u;
        sorted_keys[to] = key;
        sorted_values[to] = values[i];
    }
}
