//! Grains that part: large ones rise out of small ones, and an avalanche flows round a post.

use motes::State;

use super::states_of;

/// A scene at a step.
fn at(scene: &str, step: u32) -> State {
    states_of(scene, &[], &[step]).pop().expect("a state")
}

/// Large balls under small ones rise when all is shaken (Rosato et al. 1987), since beads that sink along a rough wall carry the middle up
/// (Knight, Jaeger & Nagel 1993). After twenty periods their mean height is 0.79 of that of the beads, from a quarter at the start; with walls
/// without friction, which do not drag, it was 0.34.
#[test]
#[ignore = "minutes on a software adapter: `tests/run --test physics --test commands -- --include-ignored` runs it"]
fn large_grains_rise_where_walls_are_rough() {
    // The floor is where it began.
    let state = at("brazil_nut", 9000);
    let mean = |places: &[glam::DVec3]| places.iter().map(|x| x.z).sum::<f64>() / places.len() as f64;
    let (large, small) = state.position().split_at(2);
    let part = mean(large) / mean(small);
    println!("large over small: {part}");
    assert!((0.6..1.5).contains(&part), "{part}");
}

/// Behind a post in a rapid flow of grains a wedge stays free of them (Gray, Tai & Noelle, J. Fluid Mech. 491, 161, 2003). Without the post
/// twenty grains were there.
#[test]
#[ignore = "minutes on a software adapter: `tests/run --test physics --test commands -- --include-ignored` runs it"]
fn an_avalanche_leaves_a_wedge_behind_a_post() {
    let state = at("avalanche", 8000);
    let within = |low: f64, high: f64| {
        let there = |x: &&glam::DVec3| (-0.09..-0.03).contains(&x.x) && (low..high).contains(&x.y.abs());
        state.position().iter().filter(there).count()
    };
    // Of equal widths: behind the post, and at both sides.
    let (behind, beside) = (within(0.0, 0.015), within(0.025, 0.04));
    println!("behind the post {behind}, beside {beside}");
    assert!(behind <= 1 && beside >= 10, "{behind} {beside}");
}
