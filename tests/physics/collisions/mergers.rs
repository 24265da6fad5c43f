//! Bodies that merge: what is conserved, which one remains, and when.

use glam::DVec3;
use motes::forces::Component;
use motes::integrators::{Adaptive, Precise};
use motes::kernel::{AdaptiveStep, Precision};
use motes::life::Life;
use motes::motion::{Held, Hold};
use motes::settings::Value;
use motes::{Setup, Simulation, State};

use super::{bodies, centre, merging, momentum, near, on, references, state, with_radii};
use crate::support::states::{force, integrator};
use crate::support::{self, Random};

/// Two bodies meet head-on, beside one that they pass.
#[test]
fn two_become_one() {
    let start = bodies(&[
        (DVec3::new(-1.0, 0.02, 0.0), DVec3::new(1.0, 0.0, 0.1), 1.0, 0.1),
        (DVec3::new(1.0, -0.01, 0.0), DVec3::new(-0.5, 0.0, 0.0), 3.0, 0.2),
        (DVec3::new(0.0, 0.0, 0.7), DVec3::ZERO, 2.0, 0.1),
    ]);
    for precision in [Precision::Single, Precision::Compensated, Precision::DoubleSingle] {
        let integrator = Box::new(Precise { integrator: integrator("leapfrog"), precision });
        let setup = Setup { integrator, ..Setup::new(start.clone(), vec![merging()], 0.01) };
        let mut simulation = references(&setup);
        simulation.step(200).expect("steps");
        let end = state(&mut simulation);
        assert_eq!(end.life(), [Life::Removed, Life::Active, Life::Active], "{precision:?}");
        let apart = |a: DVec3, b: DVec3| (a - b).length();
        let v = DVec3::new(-0.125, 0.0, 0.025);
        assert!(apart(end.velocity()[1], v) < 1e-12, "{precision:?}: {}", end.velocity()[1]);
        // Where the centre of mass of the two is.
        let x = DVec3::new(0.5, -0.0025, 0.0) + 2.0 * v;
        assert!(apart(end.position()[1], x) < 1e-9, "{precision:?}: {}", end.position()[1]);
        assert_eq!((end.mass()[1], end.mass()[0], end.velocity()[0]), (4.0, 0.0, DVec3::ZERO));
        assert_eq!((end.mass()[2], end.position()[2]), (2.0, DVec3::new(0.0, 0.0, 0.7)));
        let radius = end.scalar("collision_radius").expect("radii")[1];
        assert!((radius - 0.009f64.cbrt()).abs() < 1e-9, "{radius}");
        assert_eq!(end.whole("merged_into").expect("ids"), [2, 0, 0]);
        // They touch where (2 − 1.5 t)² + 0.03² + (0.1 t)² = 0.3²: at the end of that step.
        let exact = (6.0 - (36.0f64 - 4.0 * 2.26 * (4.0 - 0.0891)).sqrt()) / 4.52;
        let time = end.scalar("merge_time").expect("times")[0];
        assert!(time >= exact && time < exact + 0.01, "{time}, {exact}");
    }
}

/// In two words the device keeps the digits of both: one word has 6e-5 at this distance from the origin.
#[test]
fn two_words_keep_their_digits() {
    let shared = support::device();
    let at = |x: f64, v: f64, mass: f64| (DVec3::new(x, -700.0 - x / 7.0, 0.3), DVec3::new(v, v / 3.0, 0.0), mass, 0.1);
    let start = bodies(&[at(1_000.123_456_789, 512.0 + 1e-7, 1.0), at(1000.2, 512.0 - 3e-6, 3.0)]);
    for precision in [Precision::Compensated, Precision::DoubleSingle] {
        let integrator = Box::new(Precise { integrator: integrator("leapfrog"), precision });
        let setup = Setup { integrator, ..Setup::new(start.clone(), vec![merging()], 1e-6) };
        let mut simulation = on(&shared, &setup);
        simulation.step(1).expect("a step");
        let end = state(&mut simulation);
        assert_eq!(end.life(), [Life::Removed, Life::Active], "{precision:?}");
        let mean = |all: &[DVec3]| 0.25 * (all[0] + 3.0 * all[1]);
        let v = mean(start.velocity());
        // Differences of 0.08 and 4e-6 are rounded to a word, and sums to two.
        let errors = [end.position()[1] - mean(start.position()) - 1e-6 * v, end.velocity()[1] - v]
            .map(|e| e.abs().max_element());
        assert!(errors[0] < 1e-9 && errors[1] < 1e-9, "{precision:?}: {errors:?}");
    }
}

/// Removed bodies touch none, however large all are.
#[test]
fn the_largest_radii_merge() {
    let shared = support::device();
    for (radius, good) in [(2e30, true), (8e37, true), (1e38, false)] {
        let at = |x: f64, mass: f64| (DVec3::new(x, 0.0, 0.0), DVec3::ZERO, mass, radius);
        let start = bodies(&[at(0.0, 3.0), at(1.0, 2.0), at(3.0, 1.0)]);
        let setup = Setup::new(start, vec![merging()], 0.01);
        let made = Simulation::new(&shared.found.device, &shared.found.queue, &setup);
        let Ok(mut simulation) = made else {
            let text = made.err().expect("refused").to_string();
            assert!(!good && text.contains("single precision ends there"), "{radius}: {text}");
            continue;
        };
        simulation.step(3).expect("steps");
        let end = state(&mut simulation);
        assert!(good && end.life() == [Life::Active, Life::Removed, Life::Removed], "{radius}: {:?}", end.life());
    }
}

/// What is quicker than its size in a step merges all the same, and only what crosses does.
#[test]
fn paths_of_a_step_cross() {
    let shared = support::device();
    for (miss, merges) in [(0.0, true), (0.18, true), (0.22, false)] {
        for force in [merging(), near(30.0, &[])] {
            let start = bodies(&[
                (DVec3::new(-5.3, miss, 0.0), DVec3::new(7.0, 0.0, 0.0), 1.0, 0.1),
                (DVec3::new(4.0, 0.0, 0.0), DVec3::new(-4.0, 0.0, 0.0), 1.0, 0.1),
            ]);
            let setup = Setup::new(start, vec![force], 1.0);
            let (mut device, mut host) = (on(&shared, &setup), references(&setup));
            device.step(3).expect("steps");
            host.step(3).expect("steps");
            for end in [state(&mut device), state(&mut host)] {
                assert_eq!(end.life().contains(&Life::Removed), merges, "{miss}");
                assert!((momentum(&end) - DVec3::new(3.0, 0.0, 0.0)).length() < 1e-6);
            }
        }
    }
}

/// Of equal bodies the first remains; a fixed one stays where it is, and takes up a heavier one; two fixed ones, and two without mass, do not merge.
#[test]
fn which_one_remains() {
    let shared = support::device();
    let at = |x: f64, mass: f64| (DVec3::new(x, 0.0, 0.0), DVec3::new(0.0, 0.3, 0.0), mass, 0.1);
    let mut start = bodies(&[
        at(0.0, 1.0),
        at(0.1, 1.0),
        at(1.0, 1.0),
        at(1.1, 5.0),
        at(2.0, 1.0),
        at(2.1, 1.0),
        at(3.0, 0.0),
        at(3.1, 0.0),
        at(4.0, 0.0),
        at(4.1, 0.5),
    ]);
    let fixed = [2u32, 4, 5];
    fixed.iter().for_each(|id| start.velocity_mut()[*id as usize] = DVec3::ZERO);
    start.held = fixed.iter().map(|id| Held { id: *id, by: Hold::Fixed }).collect();
    let setup = Setup::new(start.clone(), vec![merging()], 0.125);
    let (mut device, mut host) = (on(&shared, &setup), references(&setup));
    device.step(2).expect("steps");
    host.step(2).expect("steps");
    for end in [state(&mut device), state(&mut host)] {
        let removed: Vec<usize> = (0..10).filter(|id| end.life()[*id] == Life::Removed).collect();
        assert_eq!(removed, [1, 3, 8]);
        assert_eq!(end.whole("merged_into").expect("ids"), [0, 1, 0, 3, 0, 0, 0, 0, 10, 0]);
        let fixed = (end.mass()[2], end.position()[2], end.velocity()[2]);
        assert_eq!(fixed, (6.0, start.position()[2], DVec3::ZERO));
        assert!((end.mass()[9] - 0.5).abs() < 1e-9 && (end.velocity()[9].y - 0.3).abs() < 1e-7);
    }
}

/// In each step each body merges with one other at most, and all that touch have merged in the end.
#[test]
fn a_chain_merges_from_step_to_step() {
    let shared = support::device();
    let row = |k: usize| (DVec3::new(0.125 * k as f64, 0.0, 0.0), DVec3::ZERO, 1.0, 0.15);
    let setup = Setup::new(bodies(&(0..6).map(row).collect::<Vec<_>>()), vec![merging()], 0.01);
    let mut simulation = on(&shared, &setup);
    let mut left = Vec::new();
    for _ in 0..6 {
        simulation.step(1).expect("a step");
        let now = state(&mut simulation);
        assert!(now.size().iter().all(|size| *size == 0.0));
        left.push(now.life().iter().filter(|life| **life == Life::Active).count());
        assert!((centre(&now).x - 0.3125).abs() < 1e-6 && (now.mass().iter().sum::<f64>() - 6.0).abs() < 1e-9);
    }
    // Of equal distances the lower row counts: first 0 and 1 merge, then 2 and 3, which are nearer to each other than 2 to that centre, then 4 and 5.
    assert!(left.windows(2).all(|two| two[1] == two[0] - 1 || two[1] == 1), "{left:?}");
    assert_eq!((left[0], left[5]), (5, 1), "{left:?}");
}

/// A ball of bodies at rest that collapses under its own gravity.
fn collapse(count: usize, seed: u64) -> State {
    let mut random = Random::new(seed);
    let mut state = State::default();
    while state.len() < count {
        let x = random.vector();
        if x.length() < 1.0 {
            state.push(x, 0.2 * random.vector(), 1.0, 0.02);
        }
    }
    let drift = momentum(&state) / count as f64;
    state.velocity_mut().iter_mut().for_each(|v| *v -= drift);
    with_radii(state, vec![0.015; count])
}

fn attraction() -> Box<dyn Component> {
    force("gravity", &[("g", Value::Number(0.002)), ("softening", Value::Number(0.01))])
}

/// Masses as the records of mergers have them: each body has those of all that were merged into it.
fn recorded(end: &State) -> Vec<f64> {
    let (into, time) = (end.whole("merged_into").expect("ids"), end.scalar("merge_time").expect("times"));
    let mut mass = vec![1.0; end.len()];
    let mut order: Vec<usize> = (0..end.len()).filter(|id| into[*id] > 0).collect();
    order.sort_by(|a, b| time[*a].total_cmp(&time[*b]));
    for id in order {
        let to = into[id] as usize - 1;
        assert!(into[to] == 0 || time[to] > time[id], "{id} went into {to} when that was gone");
        mass[to] += std::mem::take(&mut mass[id]);
    }
    mass
}

#[test]
fn a_collapse_conserves_mass_momentum_and_volume() {
    let shared = support::device();
    for (seed, precision, force) in [
        (3, Precision::Single, merging()),
        (4, Precision::Compensated, merging()),
        (5, Precision::DoubleSingle, merging()),
        (6, Precision::Single, near(0.5, &[])),
    ] {
        let start = collapse(500, seed);
        let integrator = Box::new(Precise { integrator: integrator("leapfrog"), precision });
        let setup = Setup { integrator, ..Setup::new(start.clone(), vec![attraction(), force], 0.004) };
        let mut simulation = on(&shared, &setup);
        simulation.step(260).expect("steps");
        pollster::block_on(simulation.check()).expect("no alarm");
        let end = state(&mut simulation);
        let left = end.life().iter().filter(|life| **life == Life::Active).count();
        assert!(left < 450 && left > 1, "{seed}: {left} are left");
        // Masses are integers, which single precision adds exactly.
        assert_eq!(end.mass(), recorded(&end), "{seed}");
        assert!((end.mass().iter().sum::<f64>() - 500.0).abs() < 1e-9);
        // Each of 260 sums of forces, and each merger, is rounded to 6e-8 of velocities and forces of about 1: by chance.
        assert!(momentum(&end).length() < 2e-3, "{seed}: {}", momentum(&end));
        assert!((centre(&end) - centre(&start)).length() < 1e-4, "{seed}: {}", centre(&end));
        let radii = end.scalar("collision_radius").expect("radii");
        for id in (0..500).filter(|id| end.life()[*id] == Life::Active) {
            let right = 0.015 * end.mass()[id].cbrt();
            assert!((radii[id] / right - 1.0).abs() < 1e-5, "{seed}, {id}: {} for {right}", radii[id]);
            // So do the sizes in pictures.
            assert!((end.size()[id] / (0.02 * end.mass()[id].cbrt()) - 1.0).abs() < 1e-5);
        }
        // Batches and searches change no bit.
        let other = if seed == 3 { near(0.5, &[]) } else { merging() };
        let forces = vec![attraction(), if seed == 6 { near(0.5, &[]) } else { other }];
        let integrator = setup.integrator.clone();
        let mut same = on(&shared, &Setup { integrator, ..Setup::new(start, forces, 0.004) });
        for steps in [1, 7, 92, 160] {
            same.step(steps).expect("steps");
            pollster::block_on(same.check()).expect("no alarm");
        }
        let again = state(&mut same);
        assert_eq!((end.position(), end.velocity(), end.mass()), (again.position(), again.velocity(), again.mass()));
    }
}

#[test]
fn a_run_goes_on_to_the_bit() {
    let shared = support::device();
    for precision in [Precision::Single, Precision::DoubleSingle] {
        let make = |state: State| {
            let integrator = Box::new(Precise { integrator: integrator("leapfrog"), precision });
            Setup { integrator, ..Setup::new(state, vec![attraction(), merging()], 0.004) }
        };
        let mut whole = on(&shared, &make(collapse(300, 8)));
        whole.step(150).expect("steps");
        let middle = state(&mut whole);
        assert!(middle.life().contains(&Life::Removed));
        whole.step(150).expect("steps");
        let mut again = on(&shared, &make(middle));
        assert!(again.goes_on());
        again.step(150).expect("steps");
        let ends = [state(&mut whole), state(&mut again)];
        assert_eq!(ends[0].position(), ends[1].position(), "{precision:?}");
        for name in ["collision_radius", "merge_time"] {
            assert_eq!(ends[0].scalar(name), ends[1].scalar(name), "{precision:?}, {name}");
        }
        assert_eq!(ends[0].whole("merged_into"), ends[1].whole("merged_into"));
    }
}

/// Two bodies fall from rest: t = √(r³ / 2 G M) (√(x (1 − x)) + arccos √x) from r to x r.
#[test]
fn a_fall_ends_when_the_bodies_touch() {
    let (r, reach, m) = (1.0f64, 0.02, 1.25f64);
    let x = reach / r;
    let time = (r.powi(3) / (2.0 * m)).sqrt() * ((x * (1.0 - x)).sqrt() + x.sqrt().acos());
    let start = bodies(&[
        (DVec3::new(0.8, 0.0, 0.0), DVec3::ZERO, 0.25, 0.005),
        (DVec3::new(-0.2, 0.0, 0.0), DVec3::ZERO, 1.0, 0.015),
    ]);
    let adaptive_step = AdaptiveStep { least: 1e-6, courant: 0.25, before: None };
    for (name, dt, before, after) in [("gauss_radau", 0.01, 1e-3, 0.01), ("rk4", 1e-4, 1e-4, 2e-4)] {
        let forces = vec![force("gravity", &[]), merging()];
        let mut setup = Setup { integrator: integrator(name), ..Setup::new(start.clone(), forces, dt) };
        if name == "gauss_radau" {
            setup.integrator = Box::new(Adaptive { integrator: integrator(name), adaptive_step });
        }
        let mut simulation = references(&setup);
        while state(&mut simulation).life()[0] == Life::Active {
            simulation.step(10).expect("steps");
            pollster::block_on(simulation.check()).expect("no alarm");
        }
        let end = state(&mut simulation);
        let found = end.scalar("merge_time").expect("times")[0];
        assert!(found > time - before && found < time + after, "{name}: {found} for {time}");
        // At rest, where the centre of mass is.
        assert!(end.velocity()[1].length() < 1e-9 && end.position()[1].length() < 1e-9, "{name}");
    }
}
