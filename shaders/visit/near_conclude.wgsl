// Finishes the sum of the particle in slot k. Each particle of a pair has half of its potential energy.
fn deliver(k: u32, me: Particle, sum: Sum) { conclude(me, 0.5, sum); }
