// Fixed particles are not accelerated; their share of the potential energy stays.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> acceleration: array<vec4f>; // xyz, potential
@group(1) @binding(1) var<storage, read> holds: array<vec2u>;              // id, motion

override END: u32 = 1u;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn hold(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < END { acceleration[holds[i].x] = vec4f(vec3f(), acceleration[holds[i].x].w); }
}
