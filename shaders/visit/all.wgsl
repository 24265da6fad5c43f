// All pairs.
fn meets(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) { gather(me, you, r, sum); }
