// Partial sums of errors: each workgroup adds a block of them.
struct Extent { unused_word: u32, elements: u32, chunk: u32 }

@group(3) @binding(6) var<storage, read> errors: array<f32>;
@group(3) @binding(10) var<storage, read_write> parts: array<f32>;
@group(3) @binding(11) var<uniform> extent: Extent;

@compute @workgroup_size(WORKGROUP)
fn tally(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let block = folded(group, groups);
    let first = block * extent.chunk;
    let end = min(first + extent.chunk, extent.elements);
    var sum = 0.0;
    for (var k = first + lane; k < end; k += WORKGROUP) { sum += errors[k]; }
    sum = total(lane, vec4f(sum)).x;
    if lane == 0u && first < end { parts[block] = sum; }
}
