// Coefficients V g r of neighbours found by a walk of the cell list.
fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) { meet(me, you, (you.mass / REST_DENSITY * gradient(r)) * r, sum); }
