// The velocities of a minimization: u ← keep u + push a, no farther in a step than a given length.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>;     // xyz, mass
@group(1) @binding(1) var<storage, read_write> minimize_velocity: array<vec4f>;
@group(1) @binding(2) var<storage, read> acceleration: array<vec4f>; // xyz, potential
@group(1) @binding(3) var<storage, read> minimize_change: array<vec4f>; // keep, push

override MOVE: f32 = 1.0;
const WORKGROUP: u32 = 64u;

// A vector of at most this length, of which the square need not be finite.
fn limited(v: vec3f, most: f32) -> vec3f {
    let size = max(max(abs(v.x), abs(v.y)), abs(v.z));
    if size > 0.0 {
        let part = v / size;
        let long = length(part);
        if long * size > most { return (most / long) * part; }
    }
    return v;
}

@compute @workgroup_size(WORKGROUP)
fn apply(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && position[i].w > 0.0 && !is_held(i) {
        let u = minimize_change[0].x * minimize_velocity[i].xyz + minimize_change[0].y * acceleration[i].xyz;
        minimize_velocity[i] = vec4f(limited(u, MOVE / world.dt), 0.0);
    }
}
