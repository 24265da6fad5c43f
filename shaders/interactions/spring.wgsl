// Hooke's law, damped along the spring:  F = (k (1 − L / l) + c (v_you − v_me) · r / l²) r,  with r from me to you, l = |r|.
// With rest length 0 it is k r, bit for bit. A rope (L below zero) is slack while it is shorter than −L, and never pushes.
override DAMPED: bool = true; // whether any spring is

struct Sum { force: vec3f, energy: f32 }

fn gather(me: Particle, you: Particle, r: vec3f, link: Link, sum: ptr<function, Sum>) {
    let square = dot(r, r);
    // Two particles at the same position have no direction between them.
    let apart = square > 0.0;
    let inverse = select(0.0, inverseSqrt(square), apart);
    let rest = abs(link.rest);
    let stretch = square * inverse - rest;
    var pull = link.stiffness * (1.0 - rest * inverse);
    if DAMPED { pull += link.damping * dot(velocity_of(you) - velocity_of(me), r) * inverse * inverse; }
    let rope = link.rest < 0.0;
    let taut = !rope || stretch > 0.0;
    (*sum).force += select(0.0, select(pull, max(pull, 0.0), rope), taut) * r;
    (*sum).energy += select(0.0, 0.5 * link.stiffness * stretch * stretch, taut);
}

fn finish(me: Particle, sum: Sum) -> vec4f {
    // A particle without mass has no links.
    if me.mass > 0.0 { return vec4f(sum.force, sum.energy) / me.mass; }
    return vec4f();
}

// k (t dx + (1 − t) (u · dx) u) + c (u · dv) u with t = 1 − L / l, but not below zero: a particle that compresses a spring would be
// pushed aside by it, and the matrix would not be positive (Choi & Ko 2002).
fn jvp(me: Particle, you: Particle, r: vec3f, link: Link, dx: vec3f, dv: vec3f) -> vec3f {
    let distance = length(r);
    let inverse = select(0.0, 1.0 / distance, distance > 0.0);
    let u = r * inverse;
    let across = max(0.0, 1.0 - abs(link.rest) * inverse);
    if link.rest < 0.0 && distance <= -link.rest { return vec3f(); }
    return link.stiffness * (across * dx + ((1.0 - across) * dot(u, dx)) * u) + (link.damping * dot(u, dv)) * u;
}
