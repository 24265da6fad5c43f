// How often each digit occurs in each chunk, digit by digit, each chunk by one invocation: neither barriers nor atomics,
// which are expensive on a software adapter.
struct Extent { unused_word: u32, elements: u32, block: u32, blocks: u32, shift: u32, mask: u32 }

@group(1) @binding(0) var<storage, read> keys: array<u32>;
@group(2) @binding(0) var<uniform> extent: Extent;
@group(2) @binding(1) var<storage, read_write> table: array<u32>;

const WORKGROUP: u32 = 8u;

@compute @workgroup_size(WORKGROUP)
fn radix_chunk_count(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let chunk = folded(group, groups) * WORKGROUP + lane;
    if chunk < extent.blocks {
        for (var digit = 0u; digit <= extent.mask; digit++) { table[digit * extent.blocks + chunk] = 0u; }
        let first = chunk * extent.block;
        let end = min(first + extent.block, extent.elements);
        for (var i = first; i < end; i++) { table[((keys[i] >> extent.shift) & extent.mask) * extent.blocks + chunk] += 1u; }
    }
}
