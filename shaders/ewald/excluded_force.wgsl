// The accelerations of pairs that bonds leave out.
@group(1) @binding(2) var<storage, read_write> acceleration: array<vec4f>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn excluded_force(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let mass = position[i].w;
        if mass > 0.0 {
            let all = taken_off(i);
            // Each of a pair holds half of its potential energy.
            acceleration[i] += vec4f(all.force, 0.5 * all.energy) / mass;
        }
    }
}
