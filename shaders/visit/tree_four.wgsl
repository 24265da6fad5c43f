// Four targets of a lane, eight places apart along the curve, meet a far group.
const LANES: u32 = 8u;

fn meet_group(x: vec3f, g: Group, a: Particle, b: Particle, c: Particle, d: Particle,
              sum_a: ptr<function, Sum>, sum_b: ptr<function, Sum>, sum_c: ptr<function, Sum>, sum_d: ptr<function, Sum>) {
    distant(a, g, shortest(x - a.position), sum_a);
    distant(b, g, shortest(x - b.position), sum_b);
    distant(c, g, shortest(x - c.position), sum_c);
    distant(d, g, shortest(x - d.position), sum_d);
}
