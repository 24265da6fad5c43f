// The virial of joints:  W = Σ (x − x₂) ⊗ F  over the three of each. Their forces add up to nothing, so that any point would do in place of the second.
fn gather(me: Particle, corner: Corner, sum: ptr<function, Sum>) {
    var bend = PairSum();
    pair_gather(me, corner, &bend);
    add_virial(me, shortest(particle(corner.second).position - me.position), bend, 1.0, sum);
    var whole = (*sum).whole;
    pair_gather(me, corner, &whole);
    (*sum).whole = whole;
}
