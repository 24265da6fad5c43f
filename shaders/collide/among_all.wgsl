// Among all pairs: a pair is looked at if it is so near that it may have touched, since neither of the two reaches farther than the one that reaches
// farthest of all. Only their range is kept pair by pair, and they are looked at together with all between them: on adapters without branches
// that costs little where few are near.
@group(3) @binding(4) var<storage, read> collision_reach: array<vec4f>; // x

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    // But for rounding.
    let reach = 2.001 * collision_reach[0].x;
    if dot(r, r) <= reach * reach {
        (*sum).first = select((*sum).first, you.index, (*sum).last == 0u);
        (*sum).last = you.index + 1u;
        (*sum).partner = me.index;
    }
}

fn merge(total: ptr<function, Sum>, part: Sum) {
    if part.last == 0u { prefer(total, part.partner, part.square); }
    let me = particle(part.partner);
    for (var j = part.first; j < part.last; j += 1u) {
        let you = particle_at(j);
        if j != me.index { look(me, you, refined(shortest(you.position - me.position), me, you), total); }
    }
}
