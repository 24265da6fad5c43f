// Kick of velocities in two words: v ← v + c a dt, with c the part of the step.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> velocity: array<vec4f>;     // xyz, radius
@group(1) @binding(1) var<storage, read_write> velocity_low: array<vec4f>; // xyz
@group(1) @binding(2) var<storage, read> acceleration: array<vec4f>;       // xyz, potential

override FACTOR: f32 = 1.0;
override REST: f32 = 0.0; // c dt − FACTOR dt, each factor rounded
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn kick_compensated(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let v = velocity[i];
        let rate = Words(acceleration[i].xyz, vec3f());
        let next = advanced(Words(v.xyz, velocity_low[i].xyz), rate, FACTOR * world.dt, REST);
        velocity[i] = vec4f(next.high, v.w);
        velocity_low[i] = vec4f(next.low, 0.0);
    }
}
