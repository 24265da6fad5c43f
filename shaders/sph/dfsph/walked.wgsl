// Neighbours found by a walk of the cell list push by V g r.
fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) { meet(me, you, (you.mass / REST_DENSITY * gradient(r)) * r, sum); }
