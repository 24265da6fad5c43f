// How fast the density grows by accelerations, as a part of that at rest:  Σ V (a_you − a_me) · g r.
struct Sum { change: f32 }

fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    (*sum).change += you.mass / medium.density * gradient(r) * dot(you.push - me.push, r);
}
