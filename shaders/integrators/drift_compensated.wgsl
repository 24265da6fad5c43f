// Drift of positions in two words: x ← x + c v dt, with c the part of the step.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>;     // xyz, mass
@group(1) @binding(1) var<storage, read_write> position_low: array<vec4f>; // xyz
@group(1) @binding(2) var<storage, read> velocity: array<vec4f>;           // xyz, radius
@group(1) @binding(3) var<storage, read> velocity_low: array<vec4f>;       // xyz

override FACTOR: f32 = 1.0;
override REST: f32 = 0.0; // c dt − FACTOR dt, each factor rounded
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn drift_compensated(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let x = position[i];
        let rate = Words(velocity[i].xyz, velocity_low[i].xyz);
        let next = advanced(Words(x.xyz, position_low[i].xyz), rate, FACTOR * world.dt, REST);
        position[i] = vec4f(next.high, x.w);
        position_low[i] = vec4f(next.low, 0.0);
    }
}
