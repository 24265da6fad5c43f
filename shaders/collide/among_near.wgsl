// Among the bodies of a cell list each is looked at.
fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) { look(me, you, r, sum); }
fn merge(total: ptr<function, Sum>, part: Sum) { prefer(total, part.partner, part.square); }
