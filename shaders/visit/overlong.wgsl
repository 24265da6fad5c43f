// A bond that is as long as its law admits, or longer: both ends say so, and the lower one is named.
// words 12 and 13 of the alarm: the steps that are done when such a bond is first seen; the lowest particle that has one then
fn overlong(me: Particle, you: Particle) {
    // A later step does not change the particle.
    if atomicMin(&alarm[12], world.step) >= world.step { atomicMin(&alarm[13], min(me.index, you.index)); }
}
