// All pairs.
fn meets(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) { gathered(me, you, r, sum); }
