// Beeman's first kick: v ← v + (4 a − a') dt / 6, a' ← a, with a' the acceleration of a step before; of none, a' = a.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> velocity: array<vec4f>;             // xyz, radius
@group(1) @binding(1) var<storage, read> acceleration: array<vec4f>;               // xyz, potential
@group(1) @binding(2) var<storage, read_write> earlier_acceleration: array<vec4f>; // xyz

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn beeman_first(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let v = velocity[i];
        let a = acceleration[i].xyz;
        var earlier = earlier_acceleration[i].xyz;
        if all(earlier == vec3f(0.0)) {
            earlier = a;
        }
        velocity[i] = vec4f(v.xyz + (world.dt / 6.0) * (4.0 * a - earlier), v.w);
        earlier_acceleration[i] = vec4f(a, 0.0);
    }
}
