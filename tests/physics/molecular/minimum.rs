//! `minimize`: minima of Lennard-Jones clusters (Wales & Doye, J. Phys. Chem. A 101, 5111, 1997), starts with overlaps, rest, and lockstep.

use glam::DVec3;
use motes::forces::Component;
use motes::integrators::{Adaptive, Precise};
use motes::kernel::{AdaptiveStep, Machine, Precision};
use motes::motion::{Held, Hold};
use motes::settings::Value;
use motes::{Bounds, Setup, Simulation, State};
use pollster::block_on;

use super::{cut, setup};
use crate::matter::{agrees, on_cpu, spread};
use crate::support::Random;
use crate::support::states::{force, integrator, word};

fn minimize(tolerance: f64) -> Box<dyn Component> {
    force("minimize", &[("tolerance", Value::Number(tolerance)), ("largest_move", Value::Number(0.1))])
}

/// Atoms of fcc about an octahedral hole, 38 in a truncated octahedron; or an icosahedron with its centre, of 13.
fn cluster(count: usize) -> State {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let mut places = Vec::new();
    if count == 38 {
        for [i, j, k] in (0..343).map(|n| [n % 7 - 3, n / 7 % 7 - 3, n / 49 - 3]) {
            let place = DVec3::new(f64::from(i) - 1.0, f64::from(j), f64::from(k)) * 0.5;
            if (i + j + k) % 2 == 0 && place.length() < 1.2 {
                places.push(1.55 * place);
            }
        }
    } else {
        places.push(DVec3::ZERO);
        for [a, b] in [[1.0, golden], [1.0, -golden], [-1.0, golden], [-1.0, -golden]] {
            places.extend([DVec3::new(0.0, a, b), DVec3::new(a, b, 0.0), DVec3::new(b, 0.0, a)].map(|x| 0.58 * x));
        }
    }
    assert_eq!(places.len(), count);
    let mut random = Random::new(3);
    let mut state = State::default();
    for place in places {
        state.push(place + 0.05 * random.vector(), DVec3::ZERO, 1.0, 0.0);
    }
    state
}

fn atoms(state: State, tolerance: f64) -> Setup {
    setup(state, vec![cut(20.0, "cut", "within"), minimize(tolerance)], Bounds::default(), 0.005)
}

fn energy(state: &State) -> f64 {
    state.energies().expect("energies").iter().sum()
}

fn largest(state: &State) -> f64 {
    state.scalar("minimize_force").expect("a column")[0]
}

/// The published minima have six digits; forces of 1e-6 leave 1e-12 of energy, and the parts beyond the range are 1e-8 of a pair. A state
/// holds energies in single precision: 3e-6 of 4 a particle.
#[test]
fn clusters_come_to_their_known_minima() {
    for (count, want, most) in [(13, -44.326_801, 250), (38, -173.928_427, 250)] {
        let mut simulation = on_cpu(&atoms(cluster(count), 1e-6));
        simulation.step(1).expect("a step");
        let start = block_on(simulation.snapshot()).expect("a state");
        assert!(energy(&start) > want + 1.0 && largest(&start) > 1.0, "it begins there");
        simulation.step(most).expect("steps");
        let end = block_on(simulation.snapshot()).expect("a state");
        assert!((energy(&end) - want).abs() < 1e-6 * want.abs(), "{count}: {} is not {want}", energy(&end));
        assert!(largest(&end) <= 1e-6, "{count}: {} in {most} steps", largest(&end));
        // They rest.
        simulation.step(10).expect("steps");
        let later = block_on(simulation.snapshot()).expect("a state");
        assert_eq!(later.position(), end.position());
        assert!(later.velocity().iter().all(|v| v.length() < 1e-8), "{:?}", later.velocity());
    }
}

/// In single precision forces end at some roundings of their parts, 24 of each neighbour.
#[test]
fn a_device_finds_the_same_minimum() {
    let shared = crate::support::device();
    let gpu = crate::support::machines::gpu(&shared, 38);
    let mut simulation = Simulation::on(gpu, &atoms(cluster(38), 1e-3)).expect("a simulation");
    simulation.step(250).expect("steps");
    let end = block_on(simulation.snapshot()).expect("a state");
    // The energy is flat there: F² / k, 1e-6 of 57 a particle; its sums have 1e-6 of 4.
    assert!((energy(&end) + 173.928_427).abs() < 5e-4 && largest(&end) <= 1e-3, "{} {}", energy(&end), largest(&end));
}

/// Atoms at random in a ball that is too small for them, with forces beyond 1e30: a local minimum, from which nothing has flown far.
#[test]
fn overlapping_atoms_move_apart() {
    let mut random = Random::new(8);
    let mut state = State::default();
    (0..40).for_each(|_| state.push(0.8 * random.vector(), DVec3::ZERO, 1.0, 0.0));
    let x = state.position()[0];
    state.position_mut()[1] = x + DVec3::X * 0.002;
    let mut simulation = on_cpu(&atoms(state, 1e-4));
    simulation.step(1).expect("a step");
    let start = block_on(simulation.snapshot()).expect("a state");
    assert!(largest(&start) > 1e30, "{}", largest(&start));
    simulation.step(3000).expect("steps");
    let end = block_on(simulation.snapshot()).expect("a state");
    let far = end.position().iter().map(|x| x.length()).fold(0.0, f64::max);
    assert!(largest(&end) <= 1e-4 && energy(&end) < -120.0 && far < 6.0, "{} {} {far}", largest(&end), energy(&end));
}

/// A force below the tolerance moves nothing, from the first step on; and without `minimize` a cluster swings for ever.
#[test]
fn within_the_tolerance_nothing_moves() {
    let start = cluster(13);
    let mut simulation = on_cpu(&atoms(start.clone(), 1e3));
    simulation.step(5).expect("steps");
    let end = block_on(simulation.snapshot()).expect("a state");
    assert_eq!(end.position(), block_on(on_cpu(&atoms(start.clone(), 1.0)).snapshot()).expect("one").position());
    let free = setup(start, vec![cut(20.0, "cut", "within")], Bounds::default(), 0.005);
    let mut simulation = on_cpu(&free);
    simulation.step(250).expect("steps");
    let end = block_on(simulation.snapshot()).expect("a state");
    assert!(energy(&end) > -44.2, "{}", energy(&end));
}

/// Each key changes the way down: a shorter longest step, a shorter way in a step, and rest before the minimum.
#[test]
fn every_key_matters() {
    let after = |changed: Option<(&'static str, f64)>| {
        let mut keys = [("tolerance", 1e-4), ("largest_move", 0.1), ("longest", 10.0)];
        keys.iter_mut().filter(|(key, _)| changed.is_some_and(|(name, _)| name == *key)).for_each(|(_, value)| {
            *value = changed.map_or(*value, |(_, other)| other);
        });
        let minimize = force("minimize", &keys.map(|(key, value)| (key, Value::Number(value))));
        let all = setup(cluster(13), vec![cut(20.0, "cut", "within"), minimize], Bounds::default(), 0.005);
        let mut simulation = on_cpu(&all);
        simulation.step(60).expect("steps");
        block_on(simulation.snapshot()).expect("a state").position().to_vec()
    };
    let usual = after(None);
    for other in [("tolerance", 10.0), ("largest_move", 0.002), ("longest", 1.0)] {
        assert_ne!(usual, after(Some(other)), "{other:?}");
    }
    assert_eq!(usual, after(Some(("longest", 10.0))));
}

/// Integrators that begin a step with forces of other positions are refused by name; the others come to the minimum.
#[test]
fn integrators_serve_or_are_refused() {
    for entry in motes::integrators::INTEGRATORS {
        let all = Setup { integrator: entry.by_default(), ..atoms(cluster(13), 1e-4) };
        if ["leapfrog", "beeman"].contains(&entry.name) {
            let mut simulation = on_cpu(&all);
            simulation.step(300).expect("steps");
            let end = block_on(simulation.snapshot()).expect("a state");
            assert!((energy(&end) + 44.326_801).abs() < 1e-4, "{}: {}", entry.name, energy(&end));
        } else {
            let why = all.check().expect_err(entry.name).to_string();
            assert!(why.contains("minimize") && why.contains("leapfrog or beeman"), "{}: {why}", entry.name);
        }
    }
    // A wrapped integrator has what its method has; two words are refused because of `minimize`, not of leapfrog.
    let precise = |precision| {
        let integrator = Box::new(Precise { integrator: integrator("leapfrog"), precision });
        Setup { integrator, ..atoms(cluster(13), 1e-4) }.plans(Machine::HOST).map(|_| ())
    };
    precise(Precision::Single).expect("leapfrog");
    let adaptive_step = AdaptiveStep { least: 1e-4, courant: 0.3, before: None };
    let integrator = Box::new(Adaptive { integrator: integrator("leapfrog"), adaptive_step });
    let why = Setup { integrator, ..atoms(cluster(13), 1e-4) }.check().expect_err("adaptive steps").to_string();
    assert!(why.contains("minimize has lengths of steps of its own"), "{why}");
    let why = precise(Precision::Compensated).expect_err("two words").to_string();
    assert!(why.contains("compensated") && why.contains("minimize") && !why.contains("beeman"), "{why}");
}

#[test]
fn it_agrees_with_its_reference() {
    let soft = || force("soft", &[("range", Value::Number(1.5)), ("over", word("within"))]);
    for (count, tolerance) in [(1, 1e-3), (63, 1e-3), (65, 1e3), (1000, 1e-3)] {
        let mut state = spread(count, 1.0);
        if count > 2 {
            state.held = vec![Held { id: 1, by: Hold::Fixed }];
            state.mass_mut()[2] = 0.0;
        }
        let busy = if count == 1 { &[][..] } else { &["minimize"] };
        let setup = setup(state, vec![soft(), minimize(tolerance)], Bounds::default(), 0.02);
        agrees(&setup, 12, 1.0, busy);
    }
}
