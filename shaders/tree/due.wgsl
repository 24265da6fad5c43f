// Groups of targets of which none is due do not walk: their demand is negative. Where the opening criterion has no demands, those
// of all others are zero.
@group(1) @binding(1) var<storage, read> due: array<u32>;
@group(2) @binding(0) var<storage, read> tree_id: array<u32>;
@group(2) @binding(1) var<storage, read_write> tree_demand: array<f32>;

override GROUP: u32;
// Whether the opening criterion has demands.
override RELATIVE: bool;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn due_groups(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let g = folded(group, groups) * WORKGROUP + lane;
    let first = g * GROUP;
    if first < world.count {
        var some = false;
        for (var k = first; k < min(first + GROUP, world.count); k++) { some = some || due[tree_id[k]] != 0u; }
        if !some { tree_demand[g] = -1.0; } else if !RELATIVE { tree_demand[g] = 0.0; }
    }
}
