// Beeman's first kick: v ← v + (4 a − a') dt / 6, a' ← a, with a' the acceleration at the start of the previous step; in a particle's first step a' = a.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> velocity: array<vec4f>;             // xyz, radius
@group(1) @binding(1) var<storage, read> acceleration: array<vec4f>;               // xyz, potential
@group(1) @binding(2) var<storage, read_write> earlier_acceleration: array<vec4f>; // xyz, 1 where there is one

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn beeman_first(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let v = velocity[i];
        let a = acceleration[i].xyz;
        let kept = earlier_acceleration[i];
        let earlier = select(a, kept.xyz, kept.w > 0.5);
        velocity[i] = vec4f(v.xyz + (world.dt / 6.0) * (4.0 * a - earlier), v.w);
        earlier_acceleration[i] = vec4f(a, 1.0);
    }
}
