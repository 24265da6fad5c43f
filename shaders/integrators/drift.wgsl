// Drift: x ← x + c v dt, with c the part of the step.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>; // xyz, mass
@group(1) @binding(1) var<storage, read> velocity: array<vec4f>;       // xyz, radius

override FACTOR: f32 = 1.0;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn drift(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let x = position[i];
        position[i] = vec4f(x.xyz + (FACTOR * world.dt) * velocity[i].xyz, x.w);
    }
}
