// Central forces of a pair potential. A law defines: fn energy(me, you, distance: f32, inverse: f32) -> Energy, of which inverse = 1 / distance.
fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let square = dot(r, r);
    let inverse = inverseSqrt(max(square, SMALLEST));
    let pair = energy(me, you, square * inverse, inverse);
    (*sum).force += (pair.slope * inverse) * r;
    (*sum).energy += pair.value;
}
