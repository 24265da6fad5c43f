//! A crystal that is drawn out, as in the scene `nanowire`.

/// The largest gap along a thin wire that is drawn out faster than in the scene: early, and at the end.
fn gaps() -> [f64; 2] {
    // Two cells across, between grips that draw apart by 0.8 of length per time.
    let thin = (0..6).map(|part| format!("particles.{part}.cells=[{}, 2, 2]", if part % 5 == 0 { 2 } else { 4 }));
    let fast = [("0", 12), ("1", -12)]
        .map(|(grip, far)| format!("motion.{grip}.keys=[{{ time = 2 }}, {{ time = 32, shift = [{far}, 0, 0] }}]"));
    let overrides: Vec<String> = thin.chain(fast).collect();
    let gap = |state: &motes::State| {
        let mut along: Vec<f64> = state.position().iter().map(|x| x.x).collect();
        along.sort_by(f64::total_cmp);
        along.windows(2).map(|two| two[1] - two[0]).fold(0.0, f64::max)
    };
    let all = crate::matter::states_of("nanowire", &overrides, &[1400, 6400]);
    [gap(&all[0]), gap(&all[1])]
}

/// At a strain of a sixth all is one piece, with layers half a cell apart, 0.78, or somewhat more; when it is twice as long, it has torn.
#[test]
fn a_wire_is_drawn_out_and_tears() {
    let [whole, torn] = gaps();
    assert!(whole < 1.0 && torn > 3.0, "{whole} {torn}");
}
