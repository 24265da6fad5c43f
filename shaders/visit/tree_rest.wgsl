// Whether walks had to stop: then another dispatch of all their groups continues, and otherwise none does. A walk that was
// continued and is still not finished raises an alarm.
@group(2) @binding(8) var<storage, read_write> tree_go: array<u32>;

// Workgroups that a device has in a row.
override ROW: u32;
const WORKGROUP: u32 = 64u;

var<workgroup> waiting: atomic<u32>;

// Workgroups of so many groups, in each dimension.
fn workgroups(groups: u32) -> vec3u {
    let rows = (groups + ROW - 1u) / ROW;
    return vec3u((groups + rows - 1u) / rows, rows, 1u);
}

@compute @workgroup_size(WORKGROUP)
fn rest(@builtin(local_invocation_index) lane: u32) {
    for (var first = tree.first + lane * GROUP; first < tree.end; first += WORKGROUP * GROUP) {
        if tree_kept[first - tree.first].at > 0u {
            atomicStore(&waiting, 1u);
            if tree.again > 0u { atomicMin(&alarm[2], tree_id[first]); }
        }
    }
    workgroupBarrier();
    let all = workgroups((tree.end - tree.first + GROUP - 1u) / GROUP);
    if lane < 3u { tree_go[lane] = select(0u, all[lane], atomicLoad(&waiting) > 0u); }
}
