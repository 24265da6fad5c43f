// All pairs nearer than a range, by brute force.
override RANGE: f32 = 1.0;

fn meets(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    if r.x * r.x + r.y * r.y + r.z * r.z < RANGE * RANGE { gathered(me, you, r, sum); }
}
