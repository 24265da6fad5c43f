// Broadcasts what lane 0, 1, … has loaded of a neighbour, of which only the stored position is looked at; the lane of a broadcast must be a
// constant.
fn broadcast0(q: Particle) -> Particle { return Particle(q.index, q.position, q.slot, subgroupBroadcast(q.stored, 0u)); }
fn broadcast1(q: Particle) -> Particle { return Particle(q.index, q.position, q.slot, subgroupBroadcast(q.stored, 1u)); }
fn broadcast2(q: Particle) -> Particle { return Particle(q.index, q.position, q.slot, subgroupBroadcast(q.stored, 2u)); }
fn broadcast3(q: Particle) -> Particle { return Particle(q.index, q.position, q.slot, subgroupBroadcast(q.stored, 3u)); }
fn broadcast4(q: Particle) -> Particle { return Particle(q.index, q.position, q.slot, subgroupBroadcast(q.stored, 4u)); }
fn broadcast5(q: Particle) -> Particle { return Particle(q.index, q.position, q.slot, subgroupBroadcast(q.stored, 5u)); }
fn broadcast6(q: Particle) -> Particle { return Particle(q.index, q.position, q.slot, subgroupBroadcast(q.stored, 6u)); }
fn broadcast7(q: Particle) -> Particle { return Particle(q.index, q.position, q.slot, subgroupBroadcast(q.stored, 7u)); }
