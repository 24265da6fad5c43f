// A Runge–Kutta step begins: save its start, and start the weighted sum of slopes.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>;
@group(1) @binding(1) var<storage, read> velocity: array<vec4f>;
@group(1) @binding(2) var<storage, read_write> start_position: array<vec4f>;
@group(1) @binding(3) var<storage, read_write> start_velocity: array<vec4f>;
@group(1) @binding(4) var<storage, read_write> slope_position: array<vec4f>; // Σ bᵢ vᵢ
@group(1) @binding(5) var<storage, read_write> slope_velocity: array<vec4f>; // Σ bᵢ aᵢ

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn rk_save(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        start_position[i] = position[i];
        start_velocity[i] = velocity[i];
        slope_position[i] = vec4f();
        slope_velocity[i] = vec4f();
    }
}
