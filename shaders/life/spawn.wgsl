// A pending particle that is due is spawned:  x ← x + (t − b) v,  from its initial position, as if it had started there at its spawn time b.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>; // xyz, mass
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>; // xyz, radius
@group(1) @binding(8) var<storage, read_write> life: array<u32>;       // 0 pending, 1 active, 2 removed

override END: u32 = 1u;
const WORKGROUP: u32 = 64u;
// A particle that is due within such a part of a step is due: rounding of times decides nothing.
const SOON: f32 = 0.015625;

@compute @workgroup_size(WORKGROUP)
fn spawn(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i < END {
        let birth = births[i];
        let id = birth.id;
        if life[id] == 0u && birth.time <= world.time + SOON * world.dt {
            life[id] = 1u;
            position[id] = vec4f(position[id].xyz + (world.time - birth.time) * birth.velocity, birth.mass);
            velocity[id] = vec4f(birth.velocity, velocity[id].w);
        }
    }
}
