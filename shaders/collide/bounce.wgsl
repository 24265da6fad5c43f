// Two bodies that collide part with e times the speed of approach along their line of centres:  v += w (1 + e) (u · n) n, and v' the opposite,
// with the parts w and w' of the other's mass; of a fixed one that is all.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read> position: array<vec4f>;       // xyz, mass
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>; // xyz, radius in pictures

override RESTITUTION: f32;
const WORKGROUP: u32 = 64u;

@compute @workgroup_size(WORKGROUP)
fn collide_bounce(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let i = folded(group, groups) * WORKGROUP + lane;
    if i >= world.count { return; }
    let j = collided(i);
    if j == NONE || j < i { return; }
    let r = apart(i, j);
    let n = r / length(r);
    let push = (1.0 + RESTITUTION) * dot(relative(i, j), n) * n;
    kick(i, weight(i, j) * push);
    kick(j, -weight(j, i) * push);
}
