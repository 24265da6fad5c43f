// One invocation scans all items: items[i] = sum of items[j] over j < i. For a software adapter.
struct Extent { unused_word: u32, elements: u32 }

@group(1) @binding(0) var<storage, read_write> items: array<u32>;
@group(2) @binding(0) var<uniform> extent: Extent;

@compute @workgroup_size(1)
fn scan_serial(@builtin(workgroup_id) group: vec3u) {
    if group.x == 0u {
        var before = 0u;
        for (var i = 0u; i < extent.elements; i++) {
            let item = items[i];
            items[i] = before;
            before += item;
        }
    }
}
