// The time derivatives of a rotating body:  q' = ω q / 2,  and in its own axes Euler's equations (1765)  I ω' = τ − ω × I ω.
// Between the stages of a Runge–Kutta step q is not normalized, and rotates as q / |q| does.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> orientation: array<vec4f>;
@group(1) @binding(1) var<storage, read> angular_velocity: array<vec4f>;
@group(1) @binding(2) var<storage, read> torque: array<vec4f>;
@group(1) @binding(4) var<storage, read_write> orientation_rate: array<vec4f>;
@group(1) @binding(5) var<storage, read_write> angular_acceleration: array<vec4f>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn slopes(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let q = orientation[i];
        let facing = q / sqrt(dot(q, q));
        let space = angular_velocity[i].xyz;
        let spin = inward(facing, space);
        let gyration = cross(spin, inertia[i].xyz * spin);
        let change = lightness(i) * (inward(facing, torque[i].xyz) - gyration);
        orientation_rate[i] = 0.5 * product(vec4f(space, 0.0), q);
        angular_acceleration[i] = vec4f(outward(facing, change), 0.0);
    }
}
