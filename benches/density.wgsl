// A sum over neighbours as weakly compressible fluids have it: a density and its gradient (Monaghan 1992), by Wendland's kernel of
// radius 2, with a weak pressure.
fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let q = 1.0 - 0.5 * length(r);
    let q3 = q * q * q;
    (*sum).acceleration -= you.mass * q3 * r;
    (*sum).potential += you.mass * q3 * q * (5.0 - 4.0 * q);
}

fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(0.2 * sum.acceleration, sum.potential); }
