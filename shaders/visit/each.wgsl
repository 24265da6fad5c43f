// Each particle alone. The law defines: fn force(me: Particle) -> vec4f, acceleration and potential per unit mass.
@group(1) @binding(2) var<storage, read_write> acceleration: array<vec4f>;

// Whether this is the first law: there is no acceleration yet.
override FIRST: bool = false;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn each(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let me = particle_at(i);
        let a = force(me);
        if FIRST { acceleration[i] = a; } else { acceleration[i] += a; }
        check_turns(me);
    }
}
