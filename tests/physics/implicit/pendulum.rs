//! A mass on a spring that swings: the golden row of the linear backward Euler method, and energy over long times.

use glam::DVec3;
use motes::forces::Component;
use motes::{Setup, Solver, State};

use crate::implicit::{hold, on_device, on_references, phase, setup, tie};
use crate::support::states::{force, phase as wide, vector};
use crate::support::{self};

const SOLVER: Solver = Solver { tolerance: 1e-6, iterations: 10, solves: 8 };
const GRAVITY: f64 = 9.81;
const STIFFNESS: f64 = 100.0;

fn pendulum() -> (State, Vec<Box<dyn Component>>) {
    let mut particles = State::default();
    particles.push(DVec3::X, DVec3::ZERO, 1.0, 0.0);
    particles.push(DVec3::ZERO, DVec3::ZERO, 1.0, 0.0);
    hold(&mut particles, 1);
    tie(&mut particles, [0, 1], 1.0, STIFFNESS, 0.0);
    (particles, vec![force("uniform", &[("acceleration", vector(0.0, 0.0, -GRAVITY))]), force("spring", &[])])
}

fn swing(name: &str, dt: f64) -> Setup {
    let (particles, forces) = pendulum();
    setup(&particles, forces, name, dt, SOLVER)
}

/// By the formula of Baraff & Witkin (1998) in f64, a program of its own: h = 0.01, a hundred steps.
const GOLDEN: [f64; 4] = [-0.919_295_487_728, -0.674_524_783_863, -1.401_110_610_196, 2.425_821_606_175];

#[test]
fn golden_row_of_linear_backward_euler() {
    let setup = swing("linear_backward_euler", 0.01);
    let mut references = on_references(&setup);
    references.step(100).expect("steps");
    let (x, v) = wide(&mut references);
    let error = |x: DVec3, v: DVec3| {
        let got = [x.x, x.z, v.x, v.z];
        got.iter().zip(GOLDEN).map(|(got, want)| (got - want).abs()).fold(0.0, f64::max)
    };
    // Two unknowns are solved exactly by two iterations; one is enough only where a part of 1e-6 is left of a change of
    // about a tenth of a metre per second, a few times in a hundred steps.
    let by_references = error(x[0].truncate(), v[0].truncate());
    assert!(by_references < 1e-7, "the references are off by {by_references:e}");

    let shared = support::device();
    let mut device = on_device(&shared, &setup);
    device.step(100).expect("steps");
    let (x, v) = phase(&mut device, 0);
    // Roundings of 6e-8 in velocities of 4 m/s, amplified like the explicit methods' 1e-6 to 4e-6.
    let by_device = error(x, v);
    assert!(by_device < 1e-5, "the device is off by {by_device:e}");
}

/// Kinetic, elastic and potential energy.
fn energy(x: DVec3, v: DVec3) -> f64 {
    let stretch = x.length() - 1.0;
    0.5 * v.length_squared() + 0.5 * STIFFNESS * stretch * stretch + GRAVITY * x.z
}

#[test]
fn converged_methods_over_long_times() {
    // At rest below: ½ k s² − g (1 + s) with s = g / k.
    let rest = -0.5 * GRAVITY * GRAVITY / STIFFNESS - GRAVITY;
    for (name, dt, steps) in [("backward_euler", 0.05, 4000), ("implicit_midpoint", 0.02, 4000)] {
        let mut simulation = on_references(&swing(name, dt));
        let (mut low, mut high) = (f64::MAX, f64::MIN);
        for _ in 0..steps / 10 {
            simulation.step(10).expect("steps");
            let (x, v) = wide(&mut simulation);
            let now = energy(x[0].truncate(), v[0].truncate());
            (low, high) = (low.min(now), high.max(now));
        }
        let solves = pollster::block_on(simulation.solves()).expect("a report").expect("there are solves");
        assert_eq!(solves.failures, 0, "{name}: {solves:?}");
        if name == "backward_euler" {
            let (x, v) = wide(&mut simulation);
            let last = energy(x[0].truncate(), v[0].truncate());
            assert!((last - rest).abs() < 1e-6, "{name}: {last} is not at rest, {rest}");
            assert!(high < 1e-9, "{name}: the energy rose to {high} from 0");
        } else {
            // h ω = 0.2 for the spring: the shadow energy differs by (h ω)² / 12 of the energies that change hands, about
            // ten joules; here nothing of it may drift away.
            assert!(low > -0.5 && high < 0.5, "{name}: the energy went from {low} to {high}");
        }
    }
}
