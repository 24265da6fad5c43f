// Four targets of a lane meet the eight particles, or the eight far groups, that the lanes of its subgroup hold: they are
// passed round by broadcast. The lane of a broadcast must be a constant.
const LANES: u32 = 8u;

// What stands in the way of a lane's own body, or of nobody's: the way is not 0, and nothing is there.
fn meet_body(me: Particle, slot: u32, mine: u32, index: u32, b: vec4f, sum: ptr<function, Sum>) {
    let nobody = slot == mine || slot >= tree.count;
    let r = shortest(b.xyz - me.position);
    gather(me, Particle(index, b.xyz, select(b.w, 0.0, nobody)), select(r, vec3f(1.0), nobody), sum);
}

// Everybody of the group meets everybody else of it.
fn meet_own(first: u32, place: u32, a: Particle, b: Particle, c: Particle, d: Particle,
            sum_a: ptr<function, Sum>, sum_b: ptr<function, Sum>, sum_c: ptr<function, Sum>, sum_d: ptr<function, Sum>) {
    let mine = first + place;
    for (var i = 0u; i < GROUP; i += 1u) {
        let slot = first + i;
        let you = body(min(slot, tree.count - 1u), true);
        let index = tree_id[min(slot, tree.count - 1u)];
        meet_body(a, slot, mine, index, you, sum_a);
        meet_body(b, slot, mine + LANES, index, you, sum_b);
        meet_body(c, slot, mine + 2u * LANES, index, you, sum_c);
        meet_body(d, slot, mine + 3u * LANES, index, you, sum_d);
    }
}

fn meet(index: u32, you: vec4f, a: Particle, b: Particle, c: Particle, d: Particle,
        sum_a: ptr<function, Sum>, sum_b: ptr<function, Sum>, sum_c: ptr<function, Sum>, sum_d: ptr<function, Sum>) {
    let p = Particle(index, you.xyz, you.w);
    gather(a, p, shortest(p.position - a.position), sum_a);
    gather(b, p, shortest(p.position - b.position), sum_b);
    gather(c, p, shortest(p.position - c.position), sum_c);
    gather(d, p, shortest(p.position - d.position), sum_d);
}

fn meet_group(x: vec3f, g: Group, a: Particle, b: Particle, c: Particle, d: Particle,
              sum_a: ptr<function, Sum>, sum_b: ptr<function, Sum>, sum_c: ptr<function, Sum>, sum_d: ptr<function, Sum>) {
    distant(a, g, shortest(x - a.position), sum_a);
    distant(b, g, shortest(x - b.position), sum_b);
    distant(c, g, shortest(x - c.position), sum_c);
    distant(d, g, shortest(x - d.position), sum_d);
}

// What lane 0, 1, … holds.
fn group0(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 0u), subgroupBroadcast(g.diagonal, 0u), subgroupBroadcast(g.mixed, 0u)); }
fn group1(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 1u), subgroupBroadcast(g.diagonal, 1u), subgroupBroadcast(g.mixed, 1u)); }
fn group2(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 2u), subgroupBroadcast(g.diagonal, 2u), subgroupBroadcast(g.mixed, 2u)); }
fn group3(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 3u), subgroupBroadcast(g.diagonal, 3u), subgroupBroadcast(g.mixed, 3u)); }
fn group4(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 4u), subgroupBroadcast(g.diagonal, 4u), subgroupBroadcast(g.mixed, 4u)); }
fn group5(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 5u), subgroupBroadcast(g.diagonal, 5u), subgroupBroadcast(g.mixed, 5u)); }
fn group6(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 6u), subgroupBroadcast(g.diagonal, 6u), subgroupBroadcast(g.mixed, 6u)); }
fn group7(g: Group) -> Group { return Group(subgroupBroadcast(g.mass, 7u), subgroupBroadcast(g.diagonal, 7u), subgroupBroadcast(g.mixed, 7u)); }
