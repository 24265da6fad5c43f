// Broadcasts what lane 0, 1, … holds of a neighbour; the lane of a broadcast must be a constant.
fn broadcast0(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 0u), subgroupBroadcast(q.mass, 0u), subgroupBroadcast(q.density, 0u), subgroupBroadcast(q.normal, 0u)); }
fn broadcast1(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 1u), subgroupBroadcast(q.mass, 1u), subgroupBroadcast(q.density, 1u), subgroupBroadcast(q.normal, 1u)); }
fn broadcast2(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 2u), subgroupBroadcast(q.mass, 2u), subgroupBroadcast(q.density, 2u), subgroupBroadcast(q.normal, 2u)); }
fn broadcast3(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 3u), subgroupBroadcast(q.mass, 3u), subgroupBroadcast(q.density, 3u), subgroupBroadcast(q.normal, 3u)); }
fn broadcast4(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 4u), subgroupBroadcast(q.mass, 4u), subgroupBroadcast(q.density, 4u), subgroupBroadcast(q.normal, 4u)); }
fn broadcast5(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 5u), subgroupBroadcast(q.mass, 5u), subgroupBroadcast(q.density, 5u), subgroupBroadcast(q.normal, 5u)); }
fn broadcast6(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 6u), subgroupBroadcast(q.mass, 6u), subgroupBroadcast(q.density, 6u), subgroupBroadcast(q.normal, 6u)); }
fn broadcast7(q: Particle) -> Particle { return Particle(q.index, subgroupBroadcast(q.position, 7u), subgroupBroadcast(q.mass, 7u), subgroupBroadcast(q.density, 7u), subgroupBroadcast(q.normal, 7u)); }
