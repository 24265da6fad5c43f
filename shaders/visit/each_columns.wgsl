// Each particle alone, for a law that gives no acceleration. The law defines: fn update(me: Particle), which writes its columns itself.
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn each(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let me = particle_at(i);
        update(me);
        check_turns(me);
    }
}
