// The acceleration and the energy per unit mass of pair potentials. A particle without mass is moved by nothing.
fn finish(me: Particle, sum: Sum) -> vec4f {
    if me.mass > 0.0 { return vec4f(sum.force, sum.energy) / me.mass; }
    return vec4f();
}
