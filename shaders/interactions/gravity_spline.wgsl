// Newton's law of gravity, softened by a cubic spline of support h = 2.8 ε, exact beyond it
// (Monaghan & Lattanzio 1985; Springel, Yoshida & White 2001, appendix A): GADGET's, and PKDGRAV's, whose own ε is h / 2.
// Beyond its support the spline is Newton's law.
fn softened(r: vec3f) -> f32 { return dot(r, r); }

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let h = 2.8 * softening_of(me, you);
    let distance2 = dot(r, r);
    var force: f32;
    var potential: f32;
    if distance2 >= h * h {
        let inverse = inverseSqrt(distance2);
        force = inverse * inverse * inverse;
        potential = -inverse;
    } else {
        let u = sqrt(distance2) / h;
        if u < 0.5 {
            force = 32.0 / 3.0 + u * u * (32.0 * u - 38.4);
            potential = -2.8 + u * u * (16.0 / 3.0 + u * u * (6.4 * u - 9.6));
        } else {
            force = 64.0 / 3.0 + u * (-48.0 + u * (38.4 - 32.0 / 3.0 * u)) - 1.0 / (15.0 * u * u * u);
            potential = -3.2 + 1.0 / (15.0 * u) + u * u * (32.0 / 3.0 + u * (-16.0 + u * (9.6 - 32.0 / 15.0 * u)));
        }
        force /= h * h * h;
        potential /= h;
    }
    (*sum).acceleration += (you.mass * force) * r;
    (*sum).potential += you.mass * potential;
}

fn finish(me: Particle, sum: Sum) -> vec4f { return params.g * vec4f(sum.acceleration, sum.potential); }
