// Friction and noise of a heat bath over a step (Langevin 1908; exact for a free particle, Ornstein & Uhlenbeck 1930):
//   v ← c v + √((1 − c²) k T / m) n,  c = exp(−γ dt), with n normal numbers counted by id, step and seed.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>;       // xyz, mass
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>; // xyz, radius

override TEMPERATURE: f32 = 1.0;
override FRICTION: f32 = 1.0;
override SEED_LOW: u32 = 1u;
override SEED_HIGH: u32 = 0u;

const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn langevin(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < world.count && position[i].w > 0.0 && is_active(i) && !is_held(i) {
        let lost = decayed(FRICTION * world.dt);
        let noise = sqrt(lost * (2.0 - lost) * TEMPERATURE / position[i].w);
        let n = normals(pcg4d(vec4u(id_of(i), world.step, SEED_LOW, SEED_HIGH)), world.dimensions);
        let v = velocity[i];
        velocity[i] = vec4f(v.xyz + (noise * n - lost * v.xyz), v.w);
    }
}
