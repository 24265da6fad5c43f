// Interaction of the four targets of a lane with the eight particles, or far groups, that the lanes of its subgroup hold: they are
// passed round by broadcast. The lane of a broadcast must be a constant.
// A body of a place along the curve, if it is there, and four targets from `mine` on, of which one may be that body: none
// meets itself. Both ways are computed and one is kept.
fn meet_other(slot: u32, mine: u32, me: Particle, you: Particle, sum: ptr<function, Sum>) {
    var met = *sum;
    gather(me, you, shortest(you.position - me.position), &met);
    if slot != mine && slot < world.count { *sum = met; }
}

fn meet_others(slot: u32, mine: u32, a: Particle, b: Particle, c: Particle, d: Particle,
               sum_a: ptr<function, Sum>, sum_b: ptr<function, Sum>, sum_c: ptr<function, Sum>, sum_d: ptr<function, Sum>) {
    let you = target_of(min(slot, world.count - 1u));
    meet_other(slot, mine, a, you, sum_a);
    meet_other(slot, mine + LANES, b, you, sum_b);
    meet_other(slot, mine + 2u * LANES, c, you, sum_c);
    meet_other(slot, mine + 3u * LANES, d, you, sum_d);
}

fn meet(index: u32, you: vec4f, a: Particle, b: Particle, c: Particle, d: Particle,
        sum_a: ptr<function, Sum>, sum_b: ptr<function, Sum>, sum_c: ptr<function, Sum>, sum_d: ptr<function, Sum>) {
    let p = Particle(index, you.xyz, you.w);
    gather(a, p, shortest(p.position - a.position), sum_a);
    gather(b, p, shortest(p.position - b.position), sum_b);
    gather(c, p, shortest(p.position - c.position), sum_c);
    gather(d, p, shortest(p.position - d.position), sum_d);
}

// The value of lane 0, 1, …
fn group0(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 0u), subgroupBroadcast(g.diagonal, 0u), subgroupBroadcast(g.mixed, 0u), subgroupBroadcast(g.half_trace, 0u)); }
fn group1(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 1u), subgroupBroadcast(g.diagonal, 1u), subgroupBroadcast(g.mixed, 1u), subgroupBroadcast(g.half_trace, 1u)); }
fn group2(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 2u), subgroupBroadcast(g.diagonal, 2u), subgroupBroadcast(g.mixed, 2u), subgroupBroadcast(g.half_trace, 2u)); }
fn group3(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 3u), subgroupBroadcast(g.diagonal, 3u), subgroupBroadcast(g.mixed, 3u), subgroupBroadcast(g.half_trace, 3u)); }
fn group4(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 4u), subgroupBroadcast(g.diagonal, 4u), subgroupBroadcast(g.mixed, 4u), subgroupBroadcast(g.half_trace, 4u)); }
fn group5(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 5u), subgroupBroadcast(g.diagonal, 5u), subgroupBroadcast(g.mixed, 5u), subgroupBroadcast(g.half_trace, 5u)); }
fn group6(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 6u), subgroupBroadcast(g.diagonal, 6u), subgroupBroadcast(g.mixed, 6u), subgroupBroadcast(g.half_trace, 6u)); }
fn group7(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 7u), subgroupBroadcast(g.diagonal, 7u), subgroupBroadcast(g.mixed, 7u), subgroupBroadcast(g.half_trace, 7u)); }

fn meet_bodies(index: u32, you: vec4f, a: Particle, b: Particle, c: Particle, d: Particle,
               sum_a: ptr<function, Sum>, sum_b: ptr<function, Sum>, sum_c: ptr<function, Sum>, sum_d: ptr<function, Sum>) {
    meet(subgroupBroadcast(index, 0u), subgroupBroadcast(you, 0u), a, b, c, d, sum_a, sum_b, sum_c, sum_d);
    meet(subgroupBroadcast(index, 1u), subgroupBroadcast(you, 1u), a, b, c, d, sum_a, sum_b, sum_c, sum_d);
    meet(subgroupBroadcast(index, 2u), subgroupBroadcast(you, 2u), a, b, c, d, sum_a, sum_b, sum_c, sum_d);
    meet(subgroupBroadcast(index, 3u), subgroupBroadcast(you, 3u), a, b, c, d, sum_a, sum_b, sum_c, sum_d);
    meet(subgroupBroadcast(index, 4u), subgroupBroadcast(you, 4u), a, b, c, d, sum_a, sum_b, sum_c, sum_d);
    meet(subgroupBroadcast(index, 5u), subgroupBroadcast(you, 5u), a, b, c, d, sum_a, sum_b, sum_c, sum_d);
    meet(subgroupBroadcast(index, 6u), subgroupBroadcast(you, 6u), a, b, c, d, sum_a, sum_b, sum_c, sum_d);
    meet(subgroupBroadcast(index, 7u), subgroupBroadcast(you, 7u), a, b, c, d, sum_a, sum_b, sum_c, sum_d);
}

fn meet_groups(x: vec3f, g: Group, a: Particle, b: Particle, c: Particle, d: Particle,
               sum_a: ptr<function, Sum>, sum_b: ptr<function, Sum>, sum_c: ptr<function, Sum>, sum_d: ptr<function, Sum>) {
    meet_group(subgroupBroadcast(x, 0u), group0(g), a, b, c, d, sum_a, sum_b, sum_c, sum_d);
    meet_group(subgroupBroadcast(x, 1u), group1(g), a, b, c, d, sum_a, sum_b, sum_c, sum_d);
    meet_group(subgroupBroadcast(x, 2u), group2(g), a, b, c, d, sum_a, sum_b, sum_c, sum_d);
    meet_group(subgroupBroadcast(x, 3u), group3(g), a, b, c, d, sum_a, sum_b, sum_c, sum_d);
    meet_group(subgroupBroadcast(x, 4u), group4(g), a, b, c, d, sum_a, sum_b, sum_c, sum_d);
    meet_group(subgroupBroadcast(x, 5u), group5(g), a, b, c, d, sum_a, sum_b, sum_c, sum_d);
    meet_group(subgroupBroadcast(x, 6u), group6(g), a, b, c, d, sum_a, sum_b, sum_c, sum_d);
    meet_group(subgroupBroadcast(x, 7u), group7(g), a, b, c, d, sum_a, sum_b, sum_c, sum_d);
}
