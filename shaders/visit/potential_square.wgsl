// Central forces of a pair potential of even powers of the distance, which needs no root. A law defines:
// fn even_energy(me, you, square: f32, inverse: f32) -> Energy, of which inverse = 1 / square, square = r², and slope = U'(r) / r.
fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let square = dot(r, r);
    let pair = even_energy(me, you, square, 1.0 / max(square, SMALLEST));
    (*sum).force += pair.slope * r;
    (*sum).energy += pair.value;
}
