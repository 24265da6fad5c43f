// A kick and the drift after it in one:  v ← v + c a dt,  x ← x + d v dt, to the same bits as one after the other.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>; // xyz, mass
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>; // xyz, radius
@group(1) @binding(2) var<storage, read> acceleration: array<vec4f>;   // xyz, potential

override KICK: f32 = 1.0;
override DRIFT: f32 = 1.0;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn kick_drift(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let x = position[i];
        let v = velocity[i];
        let faster = v.xyz + (KICK * world.dt) * acceleration[i].xyz;
        velocity[i] = vec4f(faster, v.w);
        position[i] = vec4f(x.xyz + (DRIFT * world.dt) * faster, x.w);
    }
}
