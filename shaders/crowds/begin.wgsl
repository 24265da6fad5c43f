// The positions at the start are allowed.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>;               // xyz, mass
@group(1) @binding(1) var<storage, read_write> allowed_position: array<vec4f>; // xyz, how often it was put back

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn begin(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count { allowed_position[i] = vec4f(position[i].xyz, allowed_position[i].w); }
}
