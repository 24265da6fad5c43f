// A joint that resists bending:  E = ½ k (θ − θ₀)²,  θ the angle between a → b and b → c:  F = k (θ − θ₀) / sin θ ∇cos θ.
struct Sum { force: vec3f, energy: f32 }

fn gather(me: Particle, corner: Corner, sum: ptr<function, Sum>) {
    let b = particle(corner.second).position;
    let there = shortest(b - particle(corner.first).position);
    let on = shortest(particle(corner.third).position - b);
    let before = length(there);
    let after = length(on);
    // Two particles at the same position define no angle.
    if before == 0.0 || after == 0.0 { return; }
    let p = there / before;
    let q = on / after;
    let cosine = dot(p, q);
    let sine = length(cross(p, q));
    let angle = atan2(sine, cosine);
    let turn = angle - corner.rest;
    // θ / sin θ is 1 where the way is straight. Where it turns right back, or is straight and should not be, there is no side to turn
    // to, and no force.
    let ratio = select(turn / max(sine, 1e-6), 1.0, angle < 1e-3 && corner.rest == 0.0);
    let from_first = (cosine * p - q) / before;
    let from_third = (p - cosine * q) / after;
    var slope = from_first;
    if corner.place == 1u { slope = -from_first - from_third; }
    if corner.place == 2u { slope = from_third; }
    (*sum).force += (corner.stiffness * ratio) * slope;
    (*sum).energy += 0.5 * corner.stiffness * turn * turn;
}

fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.force, sum.energy) / me.mass; }
