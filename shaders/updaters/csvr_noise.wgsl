// The noise of a heat bath on each free particle: normal numbers n counted by id, step and seed, and their sums √m n, m, √m n · v and n².
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>; // xyz, mass
@group(1) @binding(1) var<storage, read> velocity: array<vec4f>; // xyz, radius
@group(1) @binding(2) var<storage, read_write> thermostat_noise: array<vec4f>; // √m n, m
@group(1) @binding(3) var<storage, read_write> thermostat_work: array<vec4f>; // √m n · v, n²

override SEED_LOW: u32 = 1u;
override SEED_HIGH: u32 = 0u;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn csvr_noise(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count {
        let mass = position[i].w;
        var noise = vec3f();
        if mass > 0.0 && !is_held(i) {
            noise = normals(pcg4d(vec4u(id_of(i), world.step, SEED_LOW, SEED_HIGH)), world.dimensions);
            thermostat_noise[i] = vec4f(sqrt(mass) * noise, mass);
        } else {
            thermostat_noise[i] = vec4f();
        }
        thermostat_work[i] = vec4f(sqrt(mass) * dot(noise, velocity[i].xyz), dot(noise, noise), 0.0, 0.0);
    }
}
