// The virial of links: that of their two ends.
fn gather(me: Particle, you: Particle, r: vec3f, link: Link, sum: ptr<function, Sum>) {
    var pair = PairSum();
    pair_gather(me, you, r, link, &pair);
    add_virial(me, r, pair, 0.5, sum);
    var whole = (*sum).whole;
    pair_gather(me, you, r, link, &whole);
    (*sum).whole = whole;
}
