// Pairs that are at most so many bonds apart leave the list. Its rows, and those of the table, ascend by the ids of the others.
@group(2) @binding(8) var<storage, read_write> list: array<vec4u>;
@group(2) @binding(18) var<storage, read> excluded_start: array<u32>; // one for each particle, and the end
@group(2) @binding(19) var<storage, read> excluded: array<u32>;

const WORKGROUP: u32 = 64u;
const NONE: u32 = 0xffffffffu;

@compute @workgroup_size(WORKGROUP)
fn exclude(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let k = folded(group, groups) * WORKGROUP + lane;
    if k >= world.count { return; }
    let head = list[k];
    if head.y == NONE { return; }
    var next = excluded_start[head.y];
    let end = excluded_start[head.y + 1u];
    if next == end { return; }
    var kept = 0u;
    for (var n = 0u; n < head.x; n += 1u) {
        let id = list[(1u + n / 4u) * world.capacity + k][n % 4u];
        while next < end {
            if excluded[next] >= id { break; }
            next += 1u;
        }
        var listed = true;
        if next < end { listed = excluded[next] != id; }
        if listed {
            list[(1u + kept / 4u) * world.capacity + k][kept % 4u] = id;
            kept += 1u;
        }
    }
    list[k].x = kept;
}
