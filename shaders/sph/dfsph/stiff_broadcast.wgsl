// Broadcasts what lane 0, 1, … holds of a neighbour; the lane of a broadcast must be a constant.
fn broadcast0(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 0u), subgroupBroadcast(q.mass, 0u), subgroupBroadcast(q.stiffness, 0u), q.slot); }
fn broadcast1(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 1u), subgroupBroadcast(q.mass, 1u), subgroupBroadcast(q.stiffness, 1u), q.slot); }
fn broadcast2(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 2u), subgroupBroadcast(q.mass, 2u), subgroupBroadcast(q.stiffness, 2u), q.slot); }
fn broadcast3(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 3u), subgroupBroadcast(q.mass, 3u), subgroupBroadcast(q.stiffness, 3u), q.slot); }
fn broadcast4(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 4u), subgroupBroadcast(q.mass, 4u), subgroupBroadcast(q.stiffness, 4u), q.slot); }
fn broadcast5(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 5u), subgroupBroadcast(q.mass, 5u), subgroupBroadcast(q.stiffness, 5u), q.slot); }
fn broadcast6(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 6u), subgroupBroadcast(q.mass, 6u), subgroupBroadcast(q.stiffness, 6u), q.slot); }
fn broadcast7(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 7u), subgroupBroadcast(q.mass, 7u), subgroupBroadcast(q.stiffness, 7u), q.slot); }
