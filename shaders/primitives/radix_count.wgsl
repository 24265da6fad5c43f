// How often each digit occurs in each block, digit by digit: its scan gives the offsets of each block's keys.
struct Extent { unused_word: u32, elements: u32, block: u32, blocks: u32, shift: u32, mask: u32 }

@group(1) @binding(0) var<storage, read> keys: array<u32>;
@group(2) @binding(0) var<uniform> extent: Extent;
@group(2) @binding(1) var<storage, read_write> table: array<u32>;

const WORKGROUP: u32 = 256u;

var<workgroup> counts: array<atomic<u32>, WORKGROUP>;

@compute @workgroup_size(WORKGROUP)
fn radix_count(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let block = folded(group, groups);
    let first = block * extent.block;
    let end = min(first + extent.block, extent.elements);
    atomicStore(&counts[lane], 0u);
    workgroupBarrier();
    for (var i = first + lane; i < end; i += WORKGROUP) { atomicAdd(&counts[(keys[i] >> extent.shift) & extent.mask], 1u); }
    workgroupBarrier();
    if lane <= extent.mask && block < extent.blocks { table[lane * extent.blocks + block] = atomicLoad(&counts[lane]); }
}
