// A heat bath of single particles: each one that is free, active and has mass gets the velocity that the bath gives it in a step, by
// random numbers counted by id, step and seed.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>;       // xyz, mass
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>; // xyz, radius

override TEMPERATURE: f32 = 1.0;
override SEED_LOW: u32 = 1u;
override SEED_HIGH: u32 = 0u;

const WORKGROUP: u32 = 64u;

// Four random words of a particle and a count of steps.
fn words_of(i: u32, step: u32) -> vec4u { return pcg4d(vec4u(id_of(i), step, SEED_LOW, SEED_HIGH)); }

@compute @workgroup_size(WORKGROUP)
fn bath(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && position[i].w > 0.0 && is_active(i) && !is_held(i) {
        velocity[i] = vec4f(bathed(i, position[i].w, velocity[i].xyz), velocity[i].w);
    }
}
