// A law that does not say on whom it acts acts on everybody.
fn acts_on(me: Particle) -> bool { return true; }
