// items[i] = value, for i < elements.
struct Extent { unused_word: u32, elements: u32, value: u32 }

@group(1) @binding(0) var<storage, read_write> items: array<u32>;
@group(2) @binding(0) var<uniform> extent: Extent;

const WORKGROUP: u32 = 64u;
const EACH: u32 = 4u;

@compute @workgroup_size(WORKGROUP)
fn fill(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let first = folded(group, groups) * WORKGROUP * EACH + lane;
    for (var k = 0u; k < EACH; k++) {
        let i = first + k * WORKGROUP;
        if i < extent.elements { items[i] = extent.value; }
    }
}
