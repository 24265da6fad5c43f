// Two bodies that collide become one (as in Rein & Liu, A&A 537, A128, 2012), with the mass, the momentum and the centre of mass of both: the heavier
// one, or of equal ones that of the lower row; a fixed one stays where it is. Its acceleration is that of the centre of mass: what the two do to
// each other cancels. The other is removed.
@group(0) @binding(0) var<uniform> world: World;
@group(1) @binding(0) var<storage, read_write> position: array<vec4f>;     // xyz, mass
@group(1) @binding(1) var<storage, read_write> velocity: array<vec4f>;     // xyz, radius in pictures
@group(1) @binding(2) var<storage, read_write> acceleration: array<vec4f>; // xyz, potential
@group(1) @binding(8) var<storage, read_write> life: array<u32>;           // 0 pending, 1 active, 2 removed

const WORKGROUP: u32 = 64u;

// Whether the first of two, of which it has the lower row, remains.
fn stays(first: u32, second: u32) -> bool {
    if is_held(first) || is_held(second) { return is_held(first); }
    return position[first].w >= position[second].w;
}

@compute @workgroup_size(WORKGROUP)
fn collide_merge(@builtin(workgroup_id) group: vec3u, @builtin(num_workgroups) groups: vec3u, @builtin(local_invocation_index) lane: u32) {
    let row = folded(group, groups) * WORKGROUP + lane;
    if row >= world.count { return; }
    let other = collided(row);
    if other == NONE || other < row { return; }
    let remains = stays(row, other);
    let i = select(other, row, remains);
    let j = select(row, other, remains);
    let part = weight(i, j);
    approach(i, j, part);
    acceleration[i] += part * (acceleration[j] - acceleration[i]);
    position[i].w += position[j].w;
    velocity[i].w = of_both(velocity[i].w, velocity[j].w);
    life[j] = 2u;
    position[j].w = 0.0;
    velocity[j] = vec4f(vec3f(), velocity[j].w);
    acceleration[j] = vec4f();
}
