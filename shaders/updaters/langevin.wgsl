// Friction and noise of a heat bath over a step (Langevin 1908; exact for a free particle, Ornstein & Uhlenbeck 1930):
//   v ← c v + √((1 − c²) k T / m) n,  c = exp(−γ dt), with normal numbers n.
override FRICTION: f32 = 1.0;

fn bathed(i: u32, mass: f32, v: vec3f) -> vec3f {
    let lost = decayed(FRICTION * world.dt);
    let noise = sqrt(lost * (2.0 - lost) * TEMPERATURE / mass);
    return v + (noise * normals(words_of(i, world.step), world.dimensions) - lost * v);
}
