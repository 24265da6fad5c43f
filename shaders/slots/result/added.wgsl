// A law gives an acceleration and a potential energy per unit mass, which add to those of the laws before it. Each particle
// of a pair has its share of the energy.
@group(1) @binding(2) var<storage, read_write> acceleration: array<vec4f>;

fn conclude(me: Particle, share: f32, sum: Sum) { acceleration[me.index] += vec4f(1.0, 1.0, 1.0, share) * finish(me, sum); }
