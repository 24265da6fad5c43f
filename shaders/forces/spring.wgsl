// Hooke's law, damped along the spring:  F = (k (l − L) + c (v_you − v_me) · u) u,  with r = l u from me to you.
// A rope (L below zero) is slack while it is shorter than −L, and never pushes.
override DAMPED: bool = true; // whether any spring is

struct Sum { force: vec3f, energy: f32 }

fn gather(me: Particle, you: Particle, r: vec3f, link: Link, sum: ptr<function, Sum>) {
    let square = dot(r, r);
    // Two at one place have no direction between them.
    let inverse = select(0.0, inverseSqrt(square), square > 0.0);
    let u = r * inverse;
    let stretch = square * inverse - abs(link.rest);
    var tension = link.stiffness * stretch;
    if DAMPED { tension += link.damping * dot(velocity_of(you) - velocity_of(me), u); }
    let rope = link.rest < 0.0;
    let taut = !rope || stretch > 0.0;
    (*sum).force += select(0.0, select(tension, max(tension, 0.0), rope), taut) * u;
    (*sum).energy += select(0.0, 0.5 * link.stiffness * stretch * stretch, taut);
}

fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.force, sum.energy) / me.mass; }
