// The parts of a particle in the sums of a minimization, with u its velocity: m u², m u · a, m a², F².
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>; // xyz, mass
@group(1) @binding(1) var<storage, read> minimize_velocity: array<vec4f>;
@group(1) @binding(2) var<storage, read> acceleration: array<vec4f>; // xyz, potential
@group(1) @binding(3) var<storage, read_write> minimize_parts: array<vec4f>;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn measure(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let mass = position[i].w;
        let a = acceleration[i].xyz;
        let u = minimize_velocity[i].xyz;
        let parts = mass * vec4f(dot(u, u), dot(u, a), dot(a, a), mass * dot(a, a));
        minimize_parts[i] = select(vec4f(), parts, mass > 0.0 && !is_held(i));
    }
}
