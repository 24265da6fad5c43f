// The sum of each chunk, by one invocation: no barriers, which are expensive on a software adapter.
struct Extent { unused_word: u32, elements: u32, chunk: u32 }

@group(1) @binding(0) var<storage, read> items: array<u32>;
@group(2) @binding(0) var<uniform> extent: Extent;
@group(2) @binding(1) var<storage, read_write> sums: array<u32>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn scan_chunk_sums(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let place = folded(group, groups) * WORKGROUP + lane;
    let first = place * extent.chunk;
    if first < extent.elements {
        let end = min(first + extent.chunk, extent.elements);
        var sum = 0u;
        for (var i = first; i < end; i++) { sum += items[i]; }
        sums[place] = sum;
    }
}
