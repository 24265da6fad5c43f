// Eight candidates of a subgroup, each lane having loaded one of them: a law evaluates those in range.
fn consider(k: u32, slot: u32, end: u32, shift: vec3f, me: Particle, you: Particle, with_me: bool, sum: ptr<function, Sum>) {
    let r = way(me.position, you.position, shift);
    if with_me && slot < end && in_range(r) && !same(k, slot, me) { gather(me, you, r, sum); }
}

fn consider_eight(k: u32, slot: u32, end: u32, shift: vec3f, me: Particle, q: Particle, with_me: bool, sum: ptr<function, Sum>) {
    consider(k, slot, end, shift, me, broadcast0(q), with_me, sum);
    consider(k, slot + 1u, end, shift, me, broadcast1(q), with_me, sum);
    consider(k, slot + 2u, end, shift, me, broadcast2(q), with_me, sum);
    consider(k, slot + 3u, end, shift, me, broadcast3(q), with_me, sum);
    consider(k, slot + 4u, end, shift, me, broadcast4(q), with_me, sum);
    consider(k, slot + 5u, end, shift, me, broadcast5(q), with_me, sum);
    consider(k, slot + 6u, end, shift, me, broadcast6(q), with_me, sum);
    consider(k, slot + 7u, end, shift, me, broadcast7(q), with_me, sum);
}
