// Eight candidates of a subgroup, each lane having loaded one of them: those within the reach are marked, and then each lane lists
// its own, one in a turn. A store costs as much for one lane as for all, and few of eight are near.
fn mark(bit: u32, k: u32, slot: u32, end: u32, me: Particle, you: Particle, with_me: bool) -> u32 {
    return select(0u, bit, with_me && slot < end && !same(k, slot, me) && in_reach(me, you));
}

fn consider_eight(k: u32, slot: u32, end: u32, shift: vec3f, me: Particle, q: Particle, with_me: bool, sum: ptr<function, Sum>) {
    var near = mark(1u, k, slot, end, me, broadcast0(q), with_me) | mark(2u, k, slot + 1u, end, me, broadcast1(q), with_me)
        | mark(4u, k, slot + 2u, end, me, broadcast2(q), with_me) | mark(8u, k, slot + 3u, end, me, broadcast3(q), with_me)
        | mark(16u, k, slot + 4u, end, me, broadcast4(q), with_me) | mark(32u, k, slot + 5u, end, me, broadcast5(q), with_me)
        | mark(64u, k, slot + 6u, end, me, broadcast6(q), with_me) | mark(128u, k, slot + 7u, end, me, broadcast7(q), with_me);
    // A row without room for all is empty, and takes no turns.
    let number = (*sum).number + countOneBits(near);
    if number > ROOM {
        (*sum).number = number;
        near = 0u;
    }
    loop {
        if near != 0u { add(me, sorted_id[slot + firstTrailingBit(near)], sum); }
        near &= max(near, 1u) - 1u;
        if near == 0u { break; }
    }
}
