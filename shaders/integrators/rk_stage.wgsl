// A Runge–Kutta stage, the slopes (v, a) just evaluated: add b times them to the sum, and go from the start of the step
// to where the next slopes are wanted: x ← x₀ + c v dt, v ← v₀ + c a dt.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>;
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>;
@group(1) @binding(2) var<storage, read> acceleration: array<vec4f>;
@group(1) @binding(3) var<storage, read> start_position: array<vec4f>;
@group(1) @binding(4) var<storage, read> start_velocity: array<vec4f>;
@group(1) @binding(5) var<storage, read_write> slope_position: array<vec4f>;
@group(1) @binding(6) var<storage, read_write> slope_velocity: array<vec4f>;

override WEIGHT: f32 = 1.0; // b
override FACTOR: f32 = 1.0; // c
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn rk_stage(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let v = velocity[i].xyz;
        let a = acceleration[i].xyz;
        slope_position[i] += vec4f(WEIGHT * v, 0.0);
        slope_velocity[i] += vec4f(WEIGHT * a, 0.0);
        let dt = FACTOR * world.dt;
        position[i] = start_position[i] + vec4f(dt * v, 0.0);
        velocity[i] = start_velocity[i] + vec4f(dt * a, 0.0);
    }
}
