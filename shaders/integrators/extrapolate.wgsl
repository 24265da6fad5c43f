// Linear extrapolation from the middle of the step to its end: v ← 2 v − v₀.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> velocity: array<vec4f>; // xyz, radius
@group(1) @binding(1) var<storage, read> start_velocity: array<vec4f>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn extrapolate(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count { velocity[i] = 2.0 * velocity[i] - start_velocity[i]; }
}
