// Density as a state begins as that of rest.
@group(3) @binding(2) var<storage, read_write> density: array<f32>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn density_rest(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && !is_held(i) { density[i] = REST_DENSITY; }
}
