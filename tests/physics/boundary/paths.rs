//! Free particles in a box, step by step, against the straight line of which their path is the image.

use glam::DVec3;
use motes::kernel::Backend;
use motes::{Bounds, Cpu, Energy, POSITION, Side, Simulation, State};
use proptest::prelude::*;

use crate::boundary::{inside, odd, scattered, setup};
use crate::support;
use crate::support::machines::gpu;

const NAMES: [&str; 3] = ["leapfrog", "rk4", "symplectic_euler"];

/// Where a straight way of such a length leads, by counting the sides that it crosses one by one; and its direction there.
fn image(mut x: f64, mut v: f64, low: f64, high: f64, side: Side) -> (f64, f64) {
    while side != Side::Open && !(low..=high).contains(&x) {
        (x, v) = match (side, x > high) {
            (Side::Periodic, true) => (x - (high - low), v),
            (Side::Periodic, false) => (x + (high - low), v),
            (_, true) => (2.0 * high - x, -v),
            (_, false) => (2.0 * low - x, -v),
        };
    }
    (x, v)
}

/// All particles of a snapshot are where their straight ways lead; `allowed` is what a way may be wrong by \[length\].
fn follows(snapshot: &State, from: &motes::State, bounds: &Bounds, time: f64, allowed: f64) {
    for id in 0..from.len() {
        let (x, v) = (snapshot.position()[id], snapshot.velocity()[id]);
        for axis in 0..3 {
            let (low, high, side) = (bounds.low[axis], bounds.high[axis], bounds.sides[axis]);
            let speed = from.velocity()[id][axis];
            let (want, direction) = image(from.position()[id][axis] + speed * time, speed, low, high, side);
            let mut off = (x[axis] - want).abs();
            if side == Side::Periodic {
                off = off.min(high - low - off);
            }
            assert!(off <= allowed, "{side:?}: particle {id}, axis {axis}: {} is not {want}", x[axis]);
            // Next to a mirror rounding may decide whether it has been reached.
            let near = (want - low).min(high - want) <= allowed;
            assert!(
                v[axis].to_bits() == direction.to_bits() || near && v[axis].abs().to_bits() == speed.abs().to_bits(),
                "{side:?}: {v}"
            );
            let rounding = 1e-7 * low.abs().max(high.abs());
            let within = x[axis] >= low - rounding && x[axis] <= high + rounding;
            assert!(within || side == Side::Open, "{side:?}: particle {id} is outside: {x}");
        }
    }
}

fn walk<B: Backend>(mut simulation: Simulation<B>, steps: u32) -> State {
    simulation.step(steps).expect("steps");
    pollster::block_on(simulation.snapshot()).expect("a snapshot")
}

fn sides() -> impl Strategy<Value = Side> {
    prop::sample::select(vec![Side::Open, Side::Periodic, Side::Reflecting])
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, failure_persistence: None, ..ProptestConfig::default() })]

    /// By the references, in f64; dt so large that a step may cross the box many times.
    #[test]
    fn paths_are_folded_lines(
        sides in [sides(), sides(), sides()], seed in 0..1000_u64, dt in 0.01..9.0_f64, name in prop::sample::select(&NAMES[..]),
    ) {
        let bounds = odd(sides);
        let particles = inside(20, &bounds, seed);
        let setup = setup(particles.clone(), Vec::new(), name, dt, bounds);
        let steps = 100;
        let snapshot = walk(Simulation::on(Cpu::new(20).expect("some"), &setup).expect("a simulation"), steps);
        // Each step and each side rounds a number below 30 by 2e-16 of it; 100 steps of up to 20 sides. And where f32
        // cannot tell a place from the far side, it is the near one: 4e-7 once and again, seldom.
        follows(&snapshot, &particles, &bounds, f64::from(steps) * dt, 1e-6);
        let (first, last) = (kinetic(&particles), Energy::of(&snapshot).expect("energies").kinetic);
        prop_assert!((first - last).abs() < 1e-13 * first, "{first} became {last}");
    }
}

fn kinetic(particles: &motes::State) -> f64 {
    particles.velocity().iter().zip(particles.mass()).map(|(v, m)| 0.5 * m * v.length_squared()).sum()
}

#[test]
fn many_steps_on_the_device() {
    let shared = support::device();
    for side in [Side::Periodic, Side::Reflecting] {
        for name in NAMES {
            let bounds = odd([side; 3]);
            let particles = inside(500, &bounds, 3);
            let (dt, steps) = (0.25, 400);
            let setup = setup(particles.clone(), Vec::new(), name, dt, bounds);
            let snapshot = walk(Simulation::on(gpu(&shared, 500), &setup).expect("a simulation"), steps);
            // Each step rounds a place below 4 by 2.4e-7 at most, and each side that is crossed does so twice more; its
            // length is wrong by 6e-8 of up to 4. 400 steps of 1.2 sides or fewer: 5e-4, if all went one way.
            follows(&snapshot, &particles, &bounds, f64::from(steps) * dt, 5e-4);
            let last = Energy::of(&snapshot).expect("energies");
            assert!((kinetic(&particles) - last.kinetic).abs() < 1e-14 * last.kinetic, "{name}: mirrors take nothing");
        }
    }
}

/// A particle that starts outside of a periodic box, or is put there, is in it by an image; by a mirror it is thrown back.
#[test]
fn particles_outside_come_in() {
    let shared = support::device();
    for side in [Side::Periodic, Side::Reflecting] {
        let bounds = odd([side; 3]);
        let outside = scattered(100, &bounds, 4);
        let started = if side == Side::Periodic { outside.clone() } else { inside(100, &bounds, 4) };
        let setup = setup(started, Vec::new(), "leapfrog", 1e-3, bounds);
        let mut simulation = Simulation::on(gpu(&shared, 100), &setup).expect("a simulation");
        let snapshot = pollster::block_on(simulation.snapshot()).expect("a snapshot");
        follows(&snapshot, &setup.state, &bounds, 0.0, 1e-5);
        let places: Vec<_> =
            outside.position().iter().zip(outside.mass()).map(|(x, m)| x.extend(*m).as_vec4()).collect();
        simulation.write(POSITION, &places).expect("places");
        simulation.step(1).expect("a step");
        let snapshot = pollster::block_on(simulation.snapshot()).expect("a snapshot");
        let mut from = outside;
        from.velocity_mut().copy_from_slice(setup.state.velocity());
        // Numbers of up to 30 in f32.
        follows(&snapshot, &from, &bounds, 1e-3, 1e-5);
    }
}

/// Wherever f32 or f64 ends, a finite place comes to be in the box.
#[test]
fn from_however_far() {
    let shared = support::device();
    for side in [Side::Periodic, Side::Reflecting] {
        let bounds = odd([side; 3]);
        let far = [1e6_f32, -1e6, 3e9, -7e15, 1e30, -1e38, f32::MAX, f32::MIN, 1e-40, -1e-40];
        let places: Vec<_> = far.iter().map(|x| glam::Vec4::new(*x, -*x, x * 0.3, 0.5)).collect();
        let setup = setup(inside(far.len(), &bounds, 4), Vec::new(), "leapfrog", 1e-3, bounds);
        let mut device = Simulation::on(gpu(&shared, far.len()), &setup).expect("a simulation");
        let count = u32::try_from(far.len()).expect("few");
        let mut references = Simulation::on(Cpu::new(count).expect("some"), &setup).expect("a simulation");
        device.write(POSITION, &places).expect("places");
        references.write(POSITION, &places).expect("places");
        device.step(1).expect("a step");
        references.step(1).expect("a step");
        let found = [pollster::block_on(device.read(POSITION)), pollster::block_on(references.read(POSITION))];
        for x in found.into_iter().flat_map(|places| places.expect("places")) {
            let x = x.truncate();
            let (low, high) = (bounds.low.as_vec3(), bounds.high.as_vec3());
            let below = if side == Side::Periodic { x.cmplt(high) } else { x.cmple(high) };
            assert!(x.cmpge(low).all() && below.all(), "{side:?}: {x} is outside");
        }
    }
    assert_eq!(DVec3::ZERO, motes::boundary::wrapped(&Bounds::default(), DVec3::ZERO));
}
