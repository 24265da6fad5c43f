// Normalizes quaternions after a Runge–Kutta step, which preserves the norm only to its order.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> orientation: array<vec4f>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn unit_rotation(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && !is_held(i) && is_active(i) { orientation[i] /= sqrt(dot(orientation[i], orientation[i])); }
}
