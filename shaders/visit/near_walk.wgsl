// One target walks the rows around it, and meets who is in range.
fn consider(k: u32, slot: u32, end: u32, me: Particle, image: bool, sum: ptr<function, Sum>) {
    let you = candidate(slot);
    var r = you.position - me.position;
    if image { r = shortest(r); }
    if slot < end && in_range(r) && !same(k, slot, me) { gather(me, you, r, sum); }
}

fn stretch(k: u32, me: Particle, start: u32, end: u32, image: bool, sum: ptr<function, Sum>) {
    for (var slot = start; slot < end; slot += 4u) {
        consider(k, slot, end, me, image, sum);
        consider(k, slot + 1u, end, me, image, sum);
        consider(k, slot + 2u, end, me, image, sum);
        consider(k, slot + 3u, end, me, image, sum);
    }
}

fn walk(k: u32, me: Particle, sum: ptr<function, Sum>) {
    let a = around(me.position);
    let narrow = few(a.span);
    var seen = 0u;
    for (var z = 0u; z < a.span.z; z += 1u) {
        for (var y = 0u; y < a.span.y; y += 1u) {
            let first = row(a.first, z, y);
            let seam = narrow || behind(a, z, y);
            for (var p = 0u; p < PARTS; p += 1u) {
                if a.lower[p] < a.upper[p] {
                    let start = starts[first + a.lower[p]];
                    let end = starts[first + a.upper[p]];
                    seen += end - start;
                    if seen <= MOST {
                        // One of the two loops has nothing to do; which one, neighbours agree on.
                        let image = PERIODIC && (seam || p != MIDDLE);
                        stretch(k, me, start, select(end, start, image), false, sum);
                        stretch(k, me, start, select(start, end, image), true, sum);
                    }
                }
            }
        }
    }
    if seen > MOST { atomicMin(&alarm[2], me.index); }
}
