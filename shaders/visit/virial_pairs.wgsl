// The virial of pairs.
fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    var pair = PairSum();
    pair_gather(me, you, r, &pair);
    add_virial(me, r, pair, 0.5, sum);
    var whole = (*sum).whole;
    pair_gather(me, you, r, &whole);
    (*sum).whole = whole;
}
