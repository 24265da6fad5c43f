// The order of arrival is a race; this sorts the ids of each bin in ascending order. Each element counts those of its bin
// with lower ids. A bin of more than LARGEST, which would take too long, stays unsorted, and `largest` reports it.
struct Extent { unused_word: u32, elements: u32, bins: u32 }

@group(1) @binding(0) var<storage, read> keys: array<u32>;
@group(1) @binding(1) var<storage, read> starts: array<u32>;
@group(1) @binding(2) var<storage, read_write> order: array<u32>;
@group(1) @binding(3) var<storage, read_write> largest: array<atomic<u32>>;
@group(2) @binding(0) var<uniform> extent: Extent;
@group(2) @binding(1) var<storage, read> arrivals: array<u32>;

const WORKGROUP: u32 = 64u;
override LARGEST: u32 = 16384u;

// 1 if the id in this slot is lower.
fn lower(slot: u32, id: u32) -> u32 { return select(0u, 1u, arrivals[slot] < id); }

@compute @workgroup_size(WORKGROUP)
fn sort_settle(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let slot = folded(group, groups) * WORKGROUP + lane;
    if slot < extent.elements {
        let id = arrivals[slot];
        let bin = min(keys[id], extent.bins);
        let first = starts[bin];
        var end = extent.elements;
        if bin < extent.bins { end = starts[bin + 1u]; }
        if slot == first { atomicMax(&largest[0], end - first); }
        var place = slot;
        if end - first <= LARGEST {
            place = first;
            var at = first;
            while at + 8u <= end {
                place += lower(at, id) + lower(at + 1u, id) + lower(at + 2u, id) + lower(at + 3u, id);
                place += lower(at + 4u, id) + lower(at + 5u, id) + lower(at + 6u, id) + lower(at + 7u, id);
                at += 8u;
            }
            for (; at < end; at++) { place += lower(at, id); }
        }
        order[place] = id;
    }
}
