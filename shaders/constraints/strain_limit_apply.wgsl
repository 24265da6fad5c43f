// Applies a sweep over springs: particles are displaced, and their velocities change as if they had moved so during the last drift.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>; // xyz, mass
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>; // xyz, radius
@group(1) @binding(2) var<storage, read> limited: array<vec4f>;        // xyz where to, mass

override FACTOR: f32 = 1.0;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn strain_limit_apply(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let change = limited[i].xyz - position[i].xyz;
        velocity[i] += vec4f(change / (FACTOR * world.dt), 0.0);
        position[i] = limited[i];
    }
}
