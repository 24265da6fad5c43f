// Interaction of a body or a far group with the four targets of a lane, which are eight slots apart along the curve.
const LANES: u32 = 8u;

// A body of a place along the curve, if it is there, and four targets from `mine` on, of which one may be that body: none
// interacts with itself. Both ways are computed and one is kept.
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

fn meet_group(x: vec3f, g: Group, a: Particle, b: Particle, c: Particle, d: Particle,
              sum_a: ptr<function, Sum>, sum_b: ptr<function, Sum>, sum_c: ptr<function, Sum>, sum_d: ptr<function, Sum>) {
    distant(a, g, shortest(x - a.position), sum_a);
    distant(b, g, shortest(x - b.position), sum_b);
    distant(c, g, shortest(x - c.position), sum_c);
    distant(d, g, shortest(x - d.position), sum_d);
}
