// A Runge–Kutta step ends, the last slopes just evaluated: x ← x₀ + dt Σ bᵢ vᵢ, v ← v₀ + dt Σ bᵢ aᵢ.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>;
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>;
@group(1) @binding(2) var<storage, read> acceleration: array<vec4f>;
@group(1) @binding(3) var<storage, read> start_position: array<vec4f>;
@group(1) @binding(4) var<storage, read> start_velocity: array<vec4f>;
@group(1) @binding(5) var<storage, read> slope_position: array<vec4f>;
@group(1) @binding(6) var<storage, read> slope_velocity: array<vec4f>;

override WEIGHT: f32 = 1.0; // b of the last stage
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn rk_finish(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let v = slope_position[i].xyz + WEIGHT * velocity[i].xyz;
        let a = slope_velocity[i].xyz + WEIGHT * acceleration[i].xyz;
        position[i] = start_position[i] + vec4f(world.dt * v, 0.0);
        velocity[i] = start_velocity[i] + vec4f(world.dt * a, 0.0);
    }
}
