// A law gives no acceleration: it writes its columns itself.
fn conclude(me: Particle, share: f32, sum: Sum) { finish(me, sum); }
