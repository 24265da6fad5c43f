// Twice the kinetic energy of a particle that is free and has mass, m v², and 1 for its count.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>; // xyz, mass
@group(1) @binding(1) var<storage, read> velocity: array<vec4f>; // xyz, radius
@group(1) @binding(2) var<storage, read_write> thermostat_kinetic: array<vec4f>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn kinetic(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let mass = position[i].w;
        let v = velocity[i].xyz;
        thermostat_kinetic[i] = select(vec4f(), vec4f(mass * dot(v, v), 1.0, 0.0, 0.0), mass > 0.0 && !is_held(i));
    }
}
