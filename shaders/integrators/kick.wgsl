// Kick: v ← v + c a dt, with c the part of the step.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> velocity: array<vec4f>; // xyz, radius
@group(1) @binding(1) var<storage, read> acceleration: array<vec4f>;   // xyz, potential

override FACTOR: f32 = 1.0;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn kick(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let v = velocity[i];
        velocity[i] = vec4f(v.xyz + (FACTOR * world.dt) * acceleration[i].xyz, v.w);
    }
}
