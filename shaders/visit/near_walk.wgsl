// One target walks the rows around it, and evaluates those in range.
fn consider(k: u32, slot: u32, s: Stretch, me: Particle, sum: ptr<function, Sum>) {
    let you = candidate(slot);
    let r = way(me.position, you.position, s.shift);
    if slot < s.end && in_range(r) && !same(k, slot, me) { gather(me, you, r, sum); }
}

fn walk(k: u32, me: Particle, sum: ptr<function, Sum>) {
    let a = around(me.position);
    let parts = select(vec2u(1u, 2u), vec2u(0u, 3u), seam(a));
    var seen = 0u;
    for (var z = 0u; z < deep(a); z += 1u) {
        for (var y = 0u; y < a.span.y; y += 1u) {
            for (var part = parts.x; part < parts.y; part += 1u) {
                let s = stretch(a, a.cell.x, a.cell.x, z, y, part);
                seen += STRETCH + s.end - s.start;
                let end = select(s.start, s.end, seen <= MOST);
                for (var slot = s.start; slot < end; slot += 4u) {
                    consider(k, slot, s, me, sum);
                    consider(k, slot + 1u, s, me, sum);
                    consider(k, slot + 2u, s, me, sum);
                    consider(k, slot + 3u, s, me, sum);
                }
            }
        }
    }
    if seen > MOST { atomicMin(&alarm[2], me.index); }
}
