// A law without `acts_on` acts on all particles.
fn acts_on(me: Particle) -> bool { return true; }
