// Collisions with a heat bath (Andersen 1980): in a step a particle collides with the probability 1 − exp(−ν dt), and then has a velocity of
// the Maxwell distribution, of numbers counted by id, step and seed.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>;       // xyz, mass
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>; // xyz, radius

override TEMPERATURE: f32 = 1.0;
override RATE: f32 = 1.0;
override SEED_LOW: u32 = 1u;
override SEED_HIGH: u32 = 0u;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn andersen(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && position[i].w > 0.0 && is_active(i) && !is_held(i) {
        let collides = fraction(pcg4d(vec4u(id_of(i), ~world.step, SEED_LOW, SEED_HIGH)).x) < decayed(RATE * world.dt);
        if collides {
            let n = normals(pcg4d(vec4u(id_of(i), world.step, SEED_LOW, SEED_HIGH)), world.dimensions);
            velocity[i] = vec4f(sqrt(TEMPERATURE / position[i].w) * n, velocity[i].w);
        }
    }
}
