// A torque changes the angular momentum of a body:  L ← L + c τ dt, which is ω ← ω + c dt R I⁻¹ Rᵀ τ.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> orientation: array<vec4f>;
@group(1) @binding(1) var<storage, read_write> angular_velocity: array<vec4f>;
@group(1) @binding(2) var<storage, read> torque: array<vec4f>;

override FACTOR: f32 = 1.0;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn kick_rotation(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && !is_held(i) && is_active(i) {
        let q = orientation[i];
        let change = outward(q, lightness(i) * inward(q, torque[i].xyz));
        angular_velocity[i] += vec4f((FACTOR * world.dt) * change, 0.0);
    }
}
