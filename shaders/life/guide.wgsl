// A particle just spawned moves at constant velocity: forces do not act on it before it is free. Its share of the potential energy stays.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> acceleration: array<vec4f>; // xyz, potential

override END: u32 = 1u;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn guide(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < END {
        let id = births[i].id;
        if is_active(id) && world.time < births[i].free { acceleration[id] = vec4f(vec3f(), acceleration[id].w); }
    }
}
