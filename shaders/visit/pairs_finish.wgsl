// Adds the partial sums of the layers of `pairs`, in the order of the layers, and finishes the law.
override LAYERS: u32 = 1u;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn pairs_finish(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < targets() {
        var total = parts[i];
        for (var layer = 1u; layer < LAYERS; layer += 1u) {
            merge(&total, parts[layer * world.capacity + i]);
        }
        add(i, total);
        check_turns(target_at(i));
    }
}
