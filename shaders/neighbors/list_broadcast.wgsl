// Broadcasts what lane 0, 1, … has loaded of a neighbour; the lane of a broadcast must be a constant.
fn broadcast0(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 0u), subgroupBroadcast(q.position, 0u), q.slot, subgroupBroadcast(q.stored, 0u)); }
fn broadcast1(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 1u), subgroupBroadcast(q.position, 1u), q.slot, subgroupBroadcast(q.stored, 1u)); }
fn broadcast2(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 2u), subgroupBroadcast(q.position, 2u), q.slot, subgroupBroadcast(q.stored, 2u)); }
fn broadcast3(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 3u), subgroupBroadcast(q.position, 3u), q.slot, subgroupBroadcast(q.stored, 3u)); }
fn broadcast4(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 4u), subgroupBroadcast(q.position, 4u), q.slot, subgroupBroadcast(q.stored, 4u)); }
fn broadcast5(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 5u), subgroupBroadcast(q.position, 5u), q.slot, subgroupBroadcast(q.stored, 5u)); }
fn broadcast6(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 6u), subgroupBroadcast(q.position, 6u), q.slot, subgroupBroadcast(q.stored, 6u)); }
fn broadcast7(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 7u), subgroupBroadcast(q.position, 7u), q.slot, subgroupBroadcast(q.stored, 7u)); }
