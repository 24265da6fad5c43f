// A far group by its mass alone, with ρ² as the law softens it:  a = G M r / ρ³,  φ = −G M / ρ
fn distant(me: Particle, you: Group, r: vec3f, sum: ptr<function, Sum>) {
    let inverse = inverseSqrt(softened(r));
    (*sum).acceleration += (you.mass * inverse * inverse * inverse) * r;
    (*sum).potential -= you.mass * inverse;
}
