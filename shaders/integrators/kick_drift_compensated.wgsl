// A kick and the drift after it in one, in two words:  v ← v + c a dt,  x ← x + d v dt, to the same bits as one after the other.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>;     // xyz, mass
@group(1) @binding(1) var<storage, read_write> position_low: array<vec4f>; // xyz
@group(1) @binding(2) var<storage, read_write> velocity: array<vec4f>;     // xyz, radius
@group(1) @binding(3) var<storage, read_write> velocity_low: array<vec4f>; // xyz
@group(1) @binding(4) var<storage, read> acceleration: array<vec4f>;       // xyz, potential

override KICK: f32 = 1.0;
override KICK_REST: f32 = 0.0; // c dt − KICK dt, each factor rounded
override DRIFT: f32 = 1.0;
override DRIFT_REST: f32 = 0.0;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn kick_drift_compensated(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let x = position[i];
        let v = velocity[i];
        let rate = Words(acceleration[i].xyz, vec3f());
        let faster = advanced(Words(v.xyz, velocity_low[i].xyz), rate, KICK * world.dt, KICK_REST);
        let next = advanced(Words(x.xyz, position_low[i].xyz), faster, DRIFT * world.dt, DRIFT_REST);
        velocity[i] = vec4f(faster.high, v.w);
        velocity_low[i] = vec4f(faster.low, 0.0);
        position[i] = vec4f(next.high, x.w);
        position_low[i] = vec4f(next.low, 0.0);
    }
}
