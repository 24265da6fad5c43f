// The time at the end of the last step in which a pedestrian was inside.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> time_inside: array<f32>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn inside(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && is_active(i) { time_inside[i] = f32(world.step + 1u) * world.dt; }
}
