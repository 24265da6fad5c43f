// A far group by its mass M and second moments Q about the centre of mass, under the faded law: with s = r² + ε² and
// h(s) = s^(−1/2) − (2 / L) P(v):  φ = −G [M h + tr Q h′ + 2 r·Q r h″],
// a = −2 G [(M h′ + tr Q h″ + 2 r·Q r h‴) r + 2 h″ Q r]
fn distant(me: Particle, you: Group, r: vec3f, sum: ptr<function, Sum>) {
    let s = dot(r, r) + params.softening * params.softening;
    let inverse = inverseSqrt(s);
    let over = inverse * inverse;
    let rate = 2.0 * world.frequency.x;
    let square = rate * rate;
    let v = 1.0 - s * square;
    let value = 1.0 + v * (0.5 + v * (0.375 + v * (0.296344 + v * (0.309035 + v * (0.003588 + v * (0.434914 + v * (-0.227071 + v * 0.161508)))))));
    let slope = 0.5 + v * (0.75 + v * (0.889032 + v * (1.23614 + v * (0.01794 + v * (2.609484 + v * (-1.589497 + v * 1.292064))))));
    let curve = 0.75 + v * (1.778064 + v * (3.70842 + v * (0.07176 + v * (13.04742 + v * (-9.536982 + v * 9.044448)))));
    let twist = 1.778064 + v * (7.41684 + v * (0.21528 + v * (52.18968 + v * (-47.68491 + v * 54.266688))));
    let first = inverse * over * -0.5 + rate * square * slope;
    let second = inverse * over * over * 0.75 - rate * square * square * curve;
    let third = inverse * over * over * over * -1.875 + rate * square * square * square * twist;
    let q = moments(you, r);
    let trace = 2.0 * you.half_trace;
    let along = 2.0 * dot(r, q);
    if v > 0.0 {
        (*sum).acceleration -= 2.0 * ((you.mass * first + trace * second + along * third) * r + (2.0 * second) * q);
        (*sum).potential -= you.mass * (inverse - rate * value) + trace * first + along * second;
    }
}
