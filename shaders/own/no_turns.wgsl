// A law without loops: the turns of its visit are known, and below what every driver bears.
fn check_turns(me: Particle) {}
