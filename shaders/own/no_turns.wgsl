// A law without loops: the iterations of its visit are known, and below the limit of every driver.
fn check_turns(me: Particle) {}
