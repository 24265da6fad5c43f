// One target walks the rows around it, and meets who is in range.
fn consider(k: u32, slot: u32, end: u32, me: Particle, you: Particle, sum: ptr<function, Sum>) {
    let r = shortest(you.position - me.position);
    if slot < end && in_range(r) && !same(k, slot, me) { gather(me, you, r, sum); }
}

fn walk(k: u32, me: Particle, sum: ptr<function, Sum>) {
    let a = around(me.position);
    let part = parts(a);
    var seen = 0u;
    for (var z = 0u; z < a.span.z; z += 1u) {
        for (var y = 0u; y < a.span.y; y += 1u) {
            for (var p = part.x; p < part.y; p += 1u) {
                let s = slots_of(a, z, y, p);
                seen += s.y - s.x;
                let end = select(s.x, s.y, seen <= MOST);
                for (var slot = s.x; slot < end; slot += 4u) {
                    consider(k, slot, end, me, candidate(slot), sum);
                    consider(k, slot + 1u, end, me, candidate(slot + 1u), sum);
                    consider(k, slot + 2u, end, me, candidate(slot + 2u), sum);
                    consider(k, slot + 3u, end, me, candidate(slot + 3u), sum);
                }
            }
        }
    }
    if seen > MOST { atomicMin(&alarm[2], me.index); }
}
