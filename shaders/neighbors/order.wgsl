// From the order of arrival to that of ids: each particle counts those of its cell with lower ids. That costs less than to
// evaluate them, and the sums over a cell have one order, for any order of arrival.
@group(2) @binding(1) var<storage, read> starts: array<u32>;
@group(2) @binding(2) var<storage, read> keys: array<u32>;
@group(2) @binding(4) var<storage, read> slots: array<u32>;
@group(2) @binding(5) var<storage, read_write> sorted_id: array<u32>;

const WORKGROUP: u32 = 64u;
// In a cell of more (see `near`) the order is wrong, and the search raises the alarm.
override MOST: u32 = 240000u;

@compute @workgroup_size(WORKGROUP)
fn order(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let slot = folded(group, groups) * WORKGROUP + lane;
    if slot < starts[grid.cells.x * grid.cells.y * grid.cells.z * LAYERS] {
        let i = slots[slot];
        let start = starts[keys[i]];
        let next = starts[keys[i] + 1u];
        let end = min(next, start + MOST);
        var before = 0u;
        for (var j = start; j < end; j += 4u) {
            before += u32(slots[j] < i);
            before += u32(j + 1u < end && slots[j + 1u] < i);
            before += u32(j + 2u < end && slots[j + 2u] < i);
            before += u32(j + 3u < end && slots[j + 3u] < i);
        }
        sorted_id[start + before] = i;
        carry(i, start + before);
    }
}
