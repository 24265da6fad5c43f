// A law that does not say on which particles it acts acts on all.
fn acts_on(me: Particle) -> bool { return true; }
