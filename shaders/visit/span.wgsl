// What the `pairs` visits share. A law defines: fn gather(me, you, r: vec3f, sum: ptr<function, Sum>), with r from me to you,
// and fn finish(me, sum: Sum) -> vec4f, acceleration and potential per unit mass.
//
// Sources are evaluated in blocks, each with a sum of its own, so that rounding grows with √(number of blocks), not √(sources).
// One dispatch sees the sources first ≤ j < end; its layer l those from first + l · slice on. Sums over what a dispatch
// does not see are kept in `parts`, and a later dispatch takes them up again bit for bit.
struct Span { unused_word: u32, first: u32, end: u32, slice: u32 }

@group(2) @binding(0) var<uniform> span: Span;
@group(2) @binding(1) var<storage, read_write> parts: array<Sum>;

// This dispatch sees all sources in one layer: nothing is kept.
override WHOLE: bool = true;

fn resume(layer: u32, i: u32) -> Sum {
    if WHOLE || span.first == 0u || i >= targets() { return Sum(); }
    return parts[layer * world.capacity + i];
}

fn deliver(layer: u32, i: u32, sum: Sum) {
    if i >= targets() { return; }
    if WHOLE {
        add(i, sum);
    } else {
        parts[layer * world.capacity + i] = sum;
    }
}

// Each of a pair holds half of its potential energy.
fn add(i: u32, sum: Sum) {
    conclude(target_at(i), 0.5, settled(sum));
}

// No particle interacts with itself. Both ways are computed and one is kept: a branch would cost more.
fn meet_other(me: Particle, you: Particle, sum: ptr<function, Sum>) {
    var met = *sum;
    meets(me, you, refined(shortest(you.position - me.position), me, you), &met);
    if you.index != me.index { *sum = met; }
}

// You and four targets, of which one may be you.
fn meet_others(you: Particle, a: Particle, b: Particle, c: Particle, d: Particle,
               sum_a: ptr<function, Sum>, sum_b: ptr<function, Sum>, sum_c: ptr<function, Sum>, sum_d: ptr<function, Sum>) {
    meet_other(a, you, sum_a);
    meet_other(b, you, sum_b);
    meet_other(c, you, sum_c);
    meet_other(d, you, sum_d);
}

// You and four targets that are known to be others.
fn meet(you: Particle, a: Particle, b: Particle, c: Particle, d: Particle,
        sum_a: ptr<function, Sum>, sum_b: ptr<function, Sum>, sum_c: ptr<function, Sum>, sum_d: ptr<function, Sum>) {
    meets(a, you, refined(shortest(you.position - a.position), a, you), sum_a);
    meets(b, you, refined(shortest(you.position - b.position), b, you), sum_b);
    meets(c, you, refined(shortest(you.position - c.position), c, you), sum_c);
    meets(d, you, refined(shortest(you.position - d.position), d, you), sum_d);
}
