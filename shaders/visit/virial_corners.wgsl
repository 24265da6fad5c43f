// The virial of joints and dihedrals:  W = Σ (x − x₂) ⊗ F  over the corners of each. Their forces add up to nothing, so that any point would do in place of the second.
fn gather(me: Particle, corner: Corner, sum: ptr<function, Sum>) {
    var bend = PairSum();
    pair_gather(me, corner, &bend);
    add_virial(me, way_to_second(me, corner), bend, 1.0, sum);
    var whole = (*sum).whole;
    pair_gather(me, corner, &whole);
    (*sum).whole = whole;
}
