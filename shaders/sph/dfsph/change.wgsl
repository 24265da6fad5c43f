// The rate of change of the density by accelerations, relative to that at rest:  Σ V (a_you − a_me) · g r.
struct Sum { change: f32 }

fn meet(me: Particle, you: Particle, slope: vec3f, sum: ptr<function, Sum>) { (*sum).change += dot(you.push - me.push, slope); }
