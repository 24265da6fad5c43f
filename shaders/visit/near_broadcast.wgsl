// Broadcasts what lane 0, 1, … holds; the lane of a broadcast must be a constant.
fn broadcast0(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 0u), subgroupBroadcast(q.position, 0u), subgroupBroadcast(q.mass, 0u), subgroupBroadcast(q.velocity, 0u)); }
fn broadcast1(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 1u), subgroupBroadcast(q.position, 1u), subgroupBroadcast(q.mass, 1u), subgroupBroadcast(q.velocity, 1u)); }
fn broadcast2(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 2u), subgroupBroadcast(q.position, 2u), subgroupBroadcast(q.mass, 2u), subgroupBroadcast(q.velocity, 2u)); }
fn broadcast3(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 3u), subgroupBroadcast(q.position, 3u), subgroupBroadcast(q.mass, 3u), subgroupBroadcast(q.velocity, 3u)); }
fn broadcast4(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 4u), subgroupBroadcast(q.position, 4u), subgroupBroadcast(q.mass, 4u), subgroupBroadcast(q.velocity, 4u)); }
fn broadcast5(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 5u), subgroupBroadcast(q.position, 5u), subgroupBroadcast(q.mass, 5u), subgroupBroadcast(q.velocity, 5u)); }
fn broadcast6(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 6u), subgroupBroadcast(q.position, 6u), subgroupBroadcast(q.mass, 6u), subgroupBroadcast(q.velocity, 6u)); }
fn broadcast7(q: Particle) -> Particle { return Particle(subgroupBroadcast(q.index, 7u), subgroupBroadcast(q.position, 7u), subgroupBroadcast(q.mass, 7u), subgroupBroadcast(q.velocity, 7u)); }
