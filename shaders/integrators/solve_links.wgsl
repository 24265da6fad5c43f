// The contribution of links to the matrix-vector product, matrix-free. The law defines:
// fn jvp(me, you, r, link, dx, dv) -> vec3f, the change of the force on me when you move by dx, and by dv in velocity,
// relative to me. The caller defines the direction.
struct Expansion { pull: vec3f, own: vec3f }

fn is_tied(i: u32) -> bool {
    let links = links_of(i);
    return links.first < links.end;
}

// (h² K + h D) times the direction, the row of one particle.
fn pull(me: Particle, h: f32) -> vec3f {
    let mine = direction(me.index);
    var sum = vec3f();
    let links = links_of(me.index);
    for (var k = links.first; k < links.end; k += 1u) {
        let one = link_at(links, k);
        let you = particle(one.partner);
        let way = direction(one.partner) - mine;
        sum += jvp(me, you, shortest(you.position - me.position), one, (h * h) * way, h * way);
    }
    return sum;
}

// h² K times the direction, and the diagonal of −(h² K + h D): one loop for both, since loops have an end.
fn expansion(me: Particle, h: f32) -> Expansion {
    let mine = direction(me.index);
    var sum = Expansion();
    let links = links_of(me.index);
    for (var k = links.first; k < links.end; k += 1u) {
        let one = link_at(links, k);
        let you = particle(one.partner);
        let r = shortest(you.position - me.position);
        let square = h * h;
        sum.pull += jvp(me, you, r, one, square * (direction(one.partner) - mine), vec3f());
        sum.own += vec3f(
            jvp(me, you, r, one, vec3f(square, 0.0, 0.0), vec3f(h, 0.0, 0.0)).x,
            jvp(me, you, r, one, vec3f(0.0, square, 0.0), vec3f(0.0, h, 0.0)).y,
            jvp(me, you, r, one, vec3f(0.0, 0.0, square), vec3f(0.0, 0.0, h)).z,
        );
    }
    return sum;
}
