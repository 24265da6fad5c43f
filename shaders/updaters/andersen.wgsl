// Collisions with a heat bath (Andersen 1980): in a step a particle collides with the probability 1 − exp(−ν dt), and then has a velocity of
// the Maxwell distribution.
override RATE: f32 = 1.0;

fn bathed(i: u32, mass: f32, v: vec3f) -> vec3f {
    if fraction(words_of(i, ~world.step).x) >= decayed(RATE * world.dt) { return v; }
    return sqrt(TEMPERATURE / mass) * normals(words_of(i, world.step), world.dimensions);
}
