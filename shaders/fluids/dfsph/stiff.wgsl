// A particle of a fluid or a wall, and its κ; that of walls is below 0.
@group(2) @binding(5) var<storage, read> sorted_id: array<u32>;
@group(2) @binding(6) var<storage, read> sorted_position: array<vec4f>;
@group(3) @binding(4) var<storage, read> unknowns: array<Unknown>;

struct Particle { index: u32, position: vec3f, mass: f32, stiffness: f32 }

fn candidate(slot: u32) -> Particle {
    let p = sorted_position[slot];
    return Particle(sorted_id[slot], p.xyz, p.w, unknowns[slot].stiffness);
}
// What lane 0, 1, … holds, of what is asked of a neighbour; the lane of a broadcast must be a constant.
fn told0(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 0u), subgroupBroadcast(q.mass, 0u), subgroupBroadcast(q.stiffness, 0u)); }
fn told1(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 1u), subgroupBroadcast(q.mass, 1u), subgroupBroadcast(q.stiffness, 1u)); }
fn told2(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 2u), subgroupBroadcast(q.mass, 2u), subgroupBroadcast(q.stiffness, 2u)); }
fn told3(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 3u), subgroupBroadcast(q.mass, 3u), subgroupBroadcast(q.stiffness, 3u)); }
fn told4(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 4u), subgroupBroadcast(q.mass, 4u), subgroupBroadcast(q.stiffness, 4u)); }
fn told5(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 5u), subgroupBroadcast(q.mass, 5u), subgroupBroadcast(q.stiffness, 5u)); }
fn told6(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 6u), subgroupBroadcast(q.mass, 6u), subgroupBroadcast(q.stiffness, 6u)); }
fn told7(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 7u), subgroupBroadcast(q.mass, 7u), subgroupBroadcast(q.stiffness, 7u)); }
