// The pressure of walls, beside that of the fluid, in the order of its states.
@group(3) @binding(2) var<storage, read> wall_pressure: array<f32>;
@group(3) @binding(3) var<storage, read_write> flow: array<vec4f>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn wall_state(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let k = folded(group, groups) * WORKGROUP + lane;
    if k < world.count && flow[k].x == 0.0 { flow[k].y = wall_pressure[k]; }
}
