// Who is in range of whom, slot by slot: row 0 says of slot k how many are, and the n-th stands in row n, so that invocations side
// by side read side by side.
struct Particle { index: u32, position: vec3f, slot: u32 }
struct Sum { number: u32 }

@group(2) @binding(5) var<storage, read> sorted_id: array<u32>;
@group(2) @binding(6) var<storage, read> sorted_position: array<vec4f>;
@group(3) @binding(2) var<storage, read_write> pairs: array<vec4f>; // V g r, and the neighbour's slot

// Slots of a row, and rows of neighbours.
override STRIDE: u32 = 1u;
override ROOM: u32 = 1u;

fn candidate(slot: u32) -> Particle { return Particle(sorted_id[slot], sorted_position[slot].xyz, slot); }
// What lane 0, 1, … holds, of what is asked of a neighbour; the lane of a broadcast must be a constant.
fn told0(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 0u), subgroupBroadcast(q.slot, 0u)); }
fn told1(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 1u), subgroupBroadcast(q.slot, 1u)); }
fn told2(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 2u), subgroupBroadcast(q.slot, 2u)); }
fn told3(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 3u), subgroupBroadcast(q.slot, 3u)); }
fn told4(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 4u), subgroupBroadcast(q.slot, 4u)); }
fn told5(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 5u), subgroupBroadcast(q.slot, 5u)); }
fn told6(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 6u), subgroupBroadcast(q.slot, 6u)); }
fn told7(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 7u), subgroupBroadcast(q.slot, 7u)); }

fn acts_on(me: Particle) -> bool { return true; }

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    // A whole number below 2²⁴ is exact.
    (*sum).number += 1u;
    if (*sum).number <= ROOM { pairs[(*sum).number * STRIDE + me.slot].w = f32(you.slot); }
}

fn deliver(k: u32, me: Particle, sum: Sum) {
    pairs[k].w = f32(min(sum.number, ROOM));
    // There is room for twice as many as at rest.
    if sum.number > ROOM { atomicMin(&alarm[2], me.index); }
}
