// A far group by its mass M and second moments Q about the centre of mass, under the faded law: with derivatives by r² of
// h = (r² + ε²)^(−1/2) − (2 / L) P(v):  φ = −G [M h + tr Q h′ + 2 r·Q r h″],
// a = −2 G [(M h′ + tr Q h″ + 2 r·Q r h‴) r + 2 h″ Q r]
fn distant(me: Particle, you: Group, r: vec3f, sum: ptr<function, Sum>) {
    let distance2 = dot(r, r);
    let inverse = inverseSqrt(distance2 + params.softening * params.softening);
    let over = inverse * inverse;
    let rate = 2.0 * world.frequency.x;
    let square = rate * rate;
    let v = 1.0 - distance2 * square;
    let p = taper(v);
    let first = inverse * over * -0.5 + rate * square * p.y;
    let second = inverse * over * over * 0.75 - 2.0 * rate * square * square * p.z;
    let third = inverse * over * over * over * -1.875 + 6.0 * rate * square * square * square * p.w;
    let q = moments(you, r);
    let trace = 2.0 * you.half_trace;
    let along = 2.0 * dot(r, q);
    if v > 0.0 {
        (*sum).acceleration -= 2.0 * ((you.mass * first + trace * second + along * third) * r + (2.0 * second) * q);
        (*sum).potential -= you.mass * (inverse - rate * p.x) + trace * first + along * second;
    }
}
