// All pairs within a range, each invocation by itself.
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn near(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let k = grid.first + folded(group, groups) * WORKGROUP + lane;
    if k < min(grid.end, present()) {
        let me = target_of(k);
        if acts_on(me) {
            var sum = Sum();
            walk(k, me, &sum);
            deliver(k, me, sum);
        }
        check_turns(me);
    }
}
