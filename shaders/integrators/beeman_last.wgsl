// Beeman's last kick: v ← v + (2 a + a') dt / 6, with a' the acceleration at the start of the step.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> velocity: array<vec4f>;       // xyz, radius
@group(1) @binding(1) var<storage, read> acceleration: array<vec4f>;         // xyz, potential
@group(1) @binding(2) var<storage, read> earlier_acceleration: array<vec4f>; // xyz

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn beeman_last(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let v = velocity[i];
        let a = acceleration[i].xyz;
        velocity[i] = vec4f(v.xyz + (world.dt / 6.0) * (2.0 * a + earlier_acceleration[i].xyz), v.w);
    }
}
