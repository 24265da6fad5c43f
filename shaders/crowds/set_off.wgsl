// Pedestrians of models that set velocities take up theirs, as fast as walls allow.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>;       // xyz, mass
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>; // xyz, radius
@group(1) @binding(2) var<storage, read> wish: array<vec4f>;           // way, radius, speed
@group(1) @binding(3) var<storage, read> course: array<vec4f>;         // direction, speed, distance to the nearest wall

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn set_off(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && wish[i].w >= 0.0 && is_active(i) && !is_held(i) {
        let own = course[i];
        let speed = before_contact(position[i].xy, own.xy, wish[i].z, own.z * world.dt) / world.dt;
        velocity[i] = vec4f(speed * own.xy, 0.0, velocity[i].w);
    }
}
