//! A cluster far from the origin has the forces that it has there.

use crate::support::Shared;
use crate::support::scenes::{setup, with};
use crate::support::states::{accelerations, force, integrator, word};
use glam::DVec3;
use motes::integrators::Precise;
use motes::kernel::{ACCELERATION, Precision};
use motes::settings::Value;
use motes::{Setup, Simulation};

/// A Plummer sphere with G = M = 1 of scale length 1 that rests, moved; and its forces over a visit.
fn sphere(away: f64, over: &'static str, precision: Precision, seed: u32) -> Setup {
    let mut state = setup(with("plummer", &["particles.0.count=3000", &format!("particles.0.seed={seed}")])).state;
    for x in state.position_mut() {
        *x += DVec3::splat(away);
    }
    state.velocity_mut().fill(DVec3::ZERO);
    let settings = [("over", word(over)), ("theta", Value::Number(0.5)), ("softening", Value::Number(0.03))];
    let integrator = Box::new(Precise { integrator: integrator("leapfrog"), precision });
    Setup { integrator, ..Setup::new(state, vec![force("gravity", &settings)], 1e-6) }
}

/// The median and the 99th percentile of the errors of accelerations, relative to each.
fn errors(shared: &Shared, setup: &Setup) -> [f64; 2] {
    let exact = [("softening", Value::Number(0.03))];
    let want = accelerations(&[force("gravity", &exact)], &setup.state, 0.0);
    let mut simulation = Simulation::new(&shared.found.device, &shared.found.queue, setup).expect("a simulation");
    // Particles at rest move by 10⁻¹² in one step.
    simulation.step(1).expect("a step");
    let got = pollster::block_on(simulation.read(ACCELERATION)).expect("accelerations");
    let error = |(got, want): (&glam::Vec4, &glam::DVec4)| {
        (got.as_dvec4() - *want).truncate().length() / want.truncate().length()
    };
    let mut all: Vec<f64> = got.iter().zip(&want).map(error).collect();
    all.sort_by(f64::total_cmp);
    [all[all.len() / 2], all[all.len() * 99 / 100]]
}

#[test]
fn a_moved_cluster_has_the_forces_that_it_has_at_the_origin() {
    let shared = crate::support::device();
    for seed in [4, 5] {
        for over in ["pairs", "tree"] {
            let here = errors(&shared, &sphere(0.0, over, Precision::DoubleSingle, seed));
            let there = errors(&shared, &sphere(1e4, over, Precision::DoubleSingle, seed));
            let rounded = errors(&shared, &sphere(1e4, over, Precision::Compensated, seed));
            println!("{over}: {here:?} {there:?} {rounded:?}");
            // The same differences, rounded at other places; a tree has other cells, of the same sizes.
            for (there, here) in there.into_iter().zip(here) {
                assert!(there < 1.15 * here, "{over}, {seed}: {there:e}, at the origin {here:e}");
            }
            // Last places of 10⁻³ of coordinates, beside softening of 0.03 and distances of 0.1 to nearest ones.
            assert!(rounded[1] > 5e-4 && rounded[0] > 1.5 * here[0], "{over}, {seed}: {rounded:?}");
        }
    }
}

#[test]
fn visits_of_first_words_are_refused_by_name() {
    let state = sphere(0.0, "pairs", Precision::Single, 4).state;
    let text = |kind: &str, keys: &[(&'static str, Value)], precision| {
        let integrator = Box::new(Precise { integrator: integrator("leapfrog"), precision });
        let setup = Setup { integrator, ..Setup::new(state.clone(), vec![force(kind, keys)], 1e-3) };
        setup.plans(motes::kernel::Machine::HOST).err().map_or(String::new(), |error| error.to_string())
    };
    for (kind, over) in [("lennard_jones", "near"), ("lennard_jones", "list")] {
        let keys = [("over", word(over)), ("range", Value::Number(0.5))];
        let why = text(kind, &keys, Precision::DoubleSingle);
        assert!(why.contains(kind) && why.contains(over) && why.contains("\"compensated\""), "{why}");
        assert_eq!(text(kind, &keys, Precision::Compensated), "");
    }
    assert_eq!(text("gravity", &[("over", word("tree"))], Precision::DoubleSingle), "");
}
