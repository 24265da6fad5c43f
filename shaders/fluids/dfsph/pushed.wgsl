// A particle of a fluid or a wall, and how it is accelerated; walls are not. The fourth component says which it is.
@group(2) @binding(5) var<storage, read> sorted_id: array<u32>;
@group(2) @binding(6) var<storage, read> sorted_position: array<vec4f>;
@group(3) @binding(5) var<storage, read> pushes: array<vec4f>;

struct Particle { index: u32, position: vec3f, mass: f32, push: vec3f, solved: f32 }

fn candidate(slot: u32) -> Particle {
    let p = sorted_position[slot];
    let push = pushes[slot];
    return Particle(sorted_id[slot], p.xyz, p.w, push.xyz, push.w);
}
// What lane 0, 1, … holds, of what is asked of a neighbour; the lane of a broadcast must be a constant.
fn told0(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 0u), subgroupBroadcast(q.mass, 0u), subgroupBroadcast(q.push, 0u), q.solved); }
fn told1(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 1u), subgroupBroadcast(q.mass, 1u), subgroupBroadcast(q.push, 1u), q.solved); }
fn told2(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 2u), subgroupBroadcast(q.mass, 2u), subgroupBroadcast(q.push, 2u), q.solved); }
fn told3(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 3u), subgroupBroadcast(q.mass, 3u), subgroupBroadcast(q.push, 3u), q.solved); }
fn told4(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 4u), subgroupBroadcast(q.mass, 4u), subgroupBroadcast(q.push, 4u), q.solved); }
fn told5(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 5u), subgroupBroadcast(q.mass, 5u), subgroupBroadcast(q.push, 5u), q.solved); }
fn told6(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 6u), subgroupBroadcast(q.mass, 6u), subgroupBroadcast(q.push, 6u), q.solved); }
fn told7(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 7u), subgroupBroadcast(q.mass, 7u), subgroupBroadcast(q.push, 7u), q.solved); }
