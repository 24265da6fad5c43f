// Each invocation scans a chunk, from the sum of all chunks before it on.
struct Extent { unused_word: u32, elements: u32, chunk: u32 }

@group(1) @binding(0) var<storage, read_write> items: array<u32>;
@group(2) @binding(0) var<uniform> extent: Extent;
@group(2) @binding(1) var<storage, read> sums: array<u32>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn scan_chunks(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let place = folded(group, groups) * WORKGROUP + lane;
    let first = place * extent.chunk;
    let end = min(first + extent.chunk, extent.elements);
    var before = sums[place];
    for (var i = first; i < end; i++) {
        let item = items[i];
        items[i] = before;
        before += item;
    }
}
