// Checks particles, where invocations run one after another: each looks at the alarm.
@compute @workgroup_size(WORKGROUP)
fn watch(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count { note(examined(i, bar())); }
}
