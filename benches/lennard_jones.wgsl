// A Lennard-Jones liquid in its own units (Jones 1924):  U = 4 (r⁻¹² − r⁻⁶),  cut off where the search ends.
fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let w = 1.0 / dot(r, r);
    let w3 = w * w * w;
    (*sum).acceleration -= (24.0 * w * w3 * (2.0 * w3 - 1.0)) * r;
    (*sum).potential += 4.0 * w3 * (w3 - 1.0);
}

fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, sum.potential); }
