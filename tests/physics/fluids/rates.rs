//! The longest step of a fluid: what is just below it stays, what is just above it does not.

use glam::DVec3;
use motes::settings::Value;
use motes::stability::{Asks, Flow};
use motes::{Bounds, Setup, Side, State};

use crate::fluids::{gpu, setup, state};
use crate::support::states::{force, integrator};
use crate::support::{Random, device};
use Value::{Flag, Number};

const SIDE: u32 = 12;
const SPACING: f64 = 0.1;

/// A lattice at rest in a periodic box, all of whose waves have a little in them.
fn lattice(flat: bool, more: &[(&'static str, Value)], dt: f64) -> Setup {
    let (mut particles, mut random) = (State::default(), Random::new(3));
    let deep = if flat { 1 } else { SIDE };
    for id in 0..SIDE * SIDE * deep {
        let place = DVec3::new(f64::from(id % SIDE), f64::from(id / SIDE % SIDE), f64::from(id / SIDE / SIDE));
        let velocity = 1e-4 * random.vector();
        let mass = if flat { SPACING * SPACING } else { SPACING.powi(3) };
        let velocity = if flat { velocity.with_z(0.0) } else { velocity };
        particles.push(place * SPACING, velocity, mass, 0.0);
    }
    let size = DVec3::splat(f64::from(SIDE) * SPACING);
    let low = DVec3::splat(-0.5 * SPACING);
    let (low, size) = if flat { (low.with_z(0.0), size.with_z(0.0)) } else { (low, size) };
    let all = [("density", Number(1.0)), ("spacing", Number(SPACING)), ("negative_pressure", Flag(true))];
    let fluid = force("fluid", &[&all[..], more].concat());
    setup(&particles, vec![fluid], "leapfrog", dt, Bounds::new(low, low + size, Side::Periodic))
}

fn flow(setup: &Setup) -> Flow {
    pollster::block_on(Flow::of(setup, &|| integrator("leapfrog"))).expect("a verdict").expect("a fluid")
}

/// By how much the fastest has become faster in so many steps.
fn growth(setup: &Setup, steps: u32) -> f64 {
    let fastest = |state: &[(DVec3, DVec3)]| state.iter().map(|(_, v)| v.length()).fold(0.0, f64::max);
    let shared = device();
    let mut simulation = gpu(&shared, setup);
    let before = fastest(&state(&mut simulation));
    simulation.step(steps).expect("steps");
    fastest(&state(&mut simulation)) / before
}

/// Leapfrog multiplies the quickest wave by x² / 2 − 1 + x √(x² / 4 − 1) in a step, x = ω dt = 2.12: by 2.0, e²⁷ in 40 steps. What is
/// damped it multiplies by 1 − c dt = −1.2: e¹⁴ in 80, of which one sees a tenth, and a tenth of that was in this wave.
#[test]
fn what_is_just_too_long_grows() {
    let sound = [("sound_speed", Number(10.0))];
    let wendland =
        [("sound_speed", Number(10.0)), ("support", Number(3.0)), ("kernel", Value::Text("wendland".into()))];
    let viscous = [("sound_speed", Number(0.1)), ("viscosity", Number(2.0))];
    for (flat, more, asks) in [
        (true, &sound[..], Asks::Sound),
        (false, &sound[..], Asks::Sound),
        (true, &wendland[..], Asks::Sound),
        (true, &viscous[..], Asks::Friction),
        (false, &viscous[..], Asks::Friction),
    ] {
        let verdict = flow(&lattice(flat, more, 1e-3));
        assert_eq!(verdict.asks, asks);
        let (beyond, steps) = if asks == Asks::Sound { (1.06, 40) } else { (1.1, 80) };
        let [below, above] = [0.93, beyond].map(|part| growth(&lattice(flat, more, part * verdict.safe), steps));
        assert!(below < 5.0 && above > 100.0, "{more:?}: {below} {above}");
        assert!(!flow(&lattice(flat, more, 1.2 * verdict.safe)).is_lost());
        assert!(flow(&lattice(flat, more, 1.3 * verdict.safe)).is_lost());
    }
}

#[test]
fn xsph_has_a_limit_whatever_the_step() {
    let with = |xsph: f64, dt: f64| lattice(true, &[("sound_speed", Number(0.1)), ("xsph", Number(xsph))], dt);
    let most = 1.0 / flow(&with(1.0, 1e-3)).excess;
    assert!((1.5..3.0).contains(&most), "{most}");
    for dt in [1e-3, 1e-5] {
        let [below, above] = [0.93, 1.1].map(|part| growth(&with(part * most, dt), 80));
        assert!(below < 2.0 && above > 100.0, "{below} {above}");
        assert!(flow(&with(1.3 * most, dt)).is_lost() && flow(&with(most, dt)).asks == Asks::Xsph);
    }
}

#[test]
fn artificial_viscosity_counts() {
    let with = |alpha: f64| flow(&lattice(true, &[("sound_speed", Number(10.0)), ("alpha", Number(alpha))], 1e-3));
    assert_eq!([with(0.1).asks, with(10.0).asks], [Asks::Sound, Asks::Friction]);
    // Its damping goes with alpha.
    let ratio = with(20.0).safe / with(40.0).safe;
    assert!((ratio - 2.0).abs() < 0.1, "{ratio}");
}
