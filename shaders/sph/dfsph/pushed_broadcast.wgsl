// Broadcasts what lane 0, 1, … holds of a neighbour; the lane of a broadcast must be a constant.
fn broadcast0(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 0u), subgroupBroadcast(q.mass, 0u), subgroupBroadcast(q.push, 0u), q.solved, q.slot); }
fn broadcast1(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 1u), subgroupBroadcast(q.mass, 1u), subgroupBroadcast(q.push, 1u), q.solved, q.slot); }
fn broadcast2(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 2u), subgroupBroadcast(q.mass, 2u), subgroupBroadcast(q.push, 2u), q.solved, q.slot); }
fn broadcast3(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 3u), subgroupBroadcast(q.mass, 3u), subgroupBroadcast(q.push, 3u), q.solved, q.slot); }
fn broadcast4(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 4u), subgroupBroadcast(q.mass, 4u), subgroupBroadcast(q.push, 4u), q.solved, q.slot); }
fn broadcast5(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 5u), subgroupBroadcast(q.mass, 5u), subgroupBroadcast(q.push, 5u), q.solved, q.slot); }
fn broadcast6(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 6u), subgroupBroadcast(q.mass, 6u), subgroupBroadcast(q.push, 6u), q.solved, q.slot); }
fn broadcast7(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 7u), subgroupBroadcast(q.mass, 7u), subgroupBroadcast(q.push, 7u), q.solved, q.slot); }
