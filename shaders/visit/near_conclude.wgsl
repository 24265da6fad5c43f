// What becomes of the sum of the particle in slot k. Each of a pair holds half of its potential energy.
fn deliver(k: u32, me: Particle, sum: Sum) { conclude(me, 0.5, sum); }
