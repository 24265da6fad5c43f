// To the end of the step, or back to its start if it is tried again.
@group(0) @binding(0) var<uniform> world: World;
@group(2) @binding(2) var<storage, read> radau_step: array<f32>; // its length, 1 if it was accepted

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn radau_finish(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i >= world.count { return; }
    if radau_step[1] > 0.0 { go(i); } else { back(i); }
}
