// Checks particles, where many invocations run at once: words of the alarm have one address each, so that a workgroup loads and raises
// them once.
var<workgroup> fastest: atomic<u32>;
var<workgroup> shared_bar: f32;

@compute @workgroup_size(WORKGROUP)
fn watch(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    if lane == 0u {
        atomicStore(&fastest, 0u);
        shared_bar = bar();
    }
    workgroupBarrier();
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count { atomicMax(&fastest, examined(i, shared_bar)); }
    workgroupBarrier();
    if lane == 0u { note(atomicLoad(&fastest)); }
}
