// A far group by its mass M and second moments Q about the centre of mass, with ρ² = r² + ε², or r² where the law ends its softening (after McMillan & Aarseth 1993):
// φ = −G [M/ρ − tr Q / 2ρ³ + 3 r·Q r / 2ρ⁵],  a = G [(M/ρ³ − 3 tr Q / 2ρ⁵ + 15 r·Q r / 2ρ⁷) r − 3 Q r / ρ⁵]
fn distant(me: Particle, you: Group, r: vec3f, sum: ptr<function, Sum>) {
    let inverse = inverseSqrt(softened(r));
    let square = inverse * inverse;
    let q = moments(you, r);
    let twist = 1.5 * square * dot(r, q);
    let cube = inverse * square;
    (*sum).acceleration += cube * ((you.mass + square * (5.0 * twist - 3.0 * you.half_trace)) * r - (3.0 * square) * q);
    (*sum).potential -= inverse * (you.mass + square * (twist - you.half_trace));
}
