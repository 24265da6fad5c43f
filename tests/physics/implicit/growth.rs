//! What a step multiplies an oscillator's energy and a decaying velocity by (Hairer & Wanner 1996, §IV.3), on the device and
//! by the references: through the block of each particle alone, and through conjugate gradients.

use glam::DVec3;
use motes::forces::Component;
use motes::settings::Value;
use motes::{Setup, Solver, State};

use crate::implicit::{ALL, hold, on_device, on_references, phase, setup, tie};
use crate::support::states::{force, one, word};
use crate::support::{self, Shared};

/// ω², not 1.
const STRENGTH: f64 = 1.69;
/// So well that nothing but rounding is left of three unknowns.
const SOLVER: Solver = Solver { tolerance: 1e-6, iterations: 20, solves: 3 };

/// A particle about the origin, drawn back by a law of each alone, or by a spring of no length to one that is held.
fn oscillator(by_spring: bool) -> (State, Vec<Box<dyn Component>>) {
    let (x, v) = (DVec3::new(0.8, -0.3, 0.4), DVec3::new(0.2, 0.7, -0.5));
    let mut particles = one(x, v);
    if !by_spring {
        let harmonic = [("profile", word("harmonic")), ("strength", Value::Number(STRENGTH))];
        return (particles, vec![force("attractor", &harmonic)]);
    }
    particles.mass_mut()[0] = 1.5;
    particles.push(DVec3::ZERO, DVec3::ZERO, 0.7, 0.0);
    hold(&mut particles, 1);
    tie(&mut particles, [0, 1], 0.0, STRENGTH * 1.5, 0.0);
    (particles, vec![force("spring", &[])])
}

/// Particle 0 before and after some steps.
fn run(shared: &Shared, setup: &Setup, steps: u32, device: bool) -> [(DVec3, DVec3); 2] {
    if device {
        let mut simulation = on_device(shared, setup);
        let before = phase(&mut simulation, 0);
        simulation.step(steps).expect("steps");
        [before, phase(&mut simulation, 0)]
    } else {
        let mut simulation = on_references(setup);
        let before = phase(&mut simulation, 0);
        simulation.step(steps).expect("steps");
        [before, phase(&mut simulation, 0)]
    }
}

fn energy((x, v): (DVec3, DVec3)) -> f64 {
    v.length_squared() + STRENGTH * x.length_squared()
}

/// A few roundings to f32 of numbers of order one; phases are read in f32 from the references too.
const ROUNDING: f64 = 2e-6;

#[test]
fn energy_factors_of_an_oscillator() {
    let shared = support::device();
    for y in [0.1f64, 1.0, 3.7, 40.0] {
        for name in ALL {
            let want = if name.contains("euler") { 1.0 / (1.0 + y * y) } else { 1.0 };
            for (by_spring, device) in [(false, false), (false, true), (true, false), (true, true)] {
                let (particles, forces) = oscillator(by_spring);
                // The held one is not accelerated by a half step of Euler's method, since momentum has nowhere to go.
                if by_spring && name.contains("trapezoid") {
                    continue;
                }
                let setup = setup(&particles, forces, name, y / STRENGTH.sqrt(), SOLVER);
                let [before, after] = run(&shared, &setup, 1, device);
                let got = energy(after) / energy(before);
                let allowed = ROUNDING * (1.0 + y) + 3e-6 * y;
                assert!(
                    (got - want).abs() < allowed,
                    "{name} at {y}, spring {by_spring}, device {device}: {got}, {want}"
                );
            }
        }
    }
}

#[test]
fn factors_of_a_decay() {
    let shared = support::device();
    for z in [0.1f64, 1.0, 2.0, 30.0] {
        for name in ALL {
            let want = if name.contains("euler") { 1.0 / (1.0 + z) } else { (1.0 - z / 2.0) / (1.0 + z / 2.0) };
            for device in [false, true] {
                let rate = 0.8;
                let drag = vec![force("drag", &[("linear", Value::Number(rate))])];
                let setup = setup(&one(DVec3::ZERO, DVec3::new(0.6, -0.9, 0.3)), drag, name, z / rate, SOLVER);
                let [(_, before), (_, after)] = run(&shared, &setup, 1, device);
                let error = (after - want * before).length();
                // The half step of Euler's method makes numbers z times as large, which then cancel.
                assert!(error < ROUNDING * (1.0 + z), "{name} at {z}, device {device}: {after}, {want} of {before}");
            }
        }
    }
}

/// A thousand steps far beyond the limit of every explicit method.
#[test]
fn nothing_explodes_and_euler_comes_to_rest() {
    let shared = support::device();
    for name in ALL {
        let (particles, forces) = oscillator(false);
        let setup = setup(&particles, forces, name, 5.0, SOLVER);
        let [before, after] = run(&shared, &setup, 1000, true);
        let kept = energy(after) / energy(before);
        if name.contains("euler") {
            assert!(kept < 1e-30, "{name}: {kept:e} of the energy is left");
        } else {
            // h ω / 2 = 3.25: half a step makes numbers that much larger, which then cancel. In a thousand steps that is
            // 1000 (1 + 3.25)² 6e-8 in the energy, if all roundings go one way.
            assert!((kept - 1.0).abs() < 1e-3, "{name}: the energy became {kept} of what it was");
        }
    }
}
