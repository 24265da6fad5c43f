//! Heat capacities from fluctuations: of a gas, of a crystal of oscillators, and of a Lennard-Jones liquid.

use std::any::Any;
use std::sync::Arc;

use glam::DVec3;
use motes::forces::Component;
use motes::kernel::Backend;
use motes::links::Link;
use motes::measure::{Ensemble, HeatCapacity, Moment, Series, measure};
use motes::motion::{Held, Hold};
use motes::settings::Settings;
use motes::settings::Value::{self, Flag, Number};
use motes::{Setup, Simulation, State};
use pollster::block_on;

use super::barostats::on_gpu;
use super::liquid::{DENSITY, LIQUID, RANGE};
use super::{cut, setup};
use crate::matter::on_cpu;
use crate::support::states::force;

/// The measure of so many states of a run, each some steps after the last.
fn measured<B: Backend>(
    simulation: &mut Simulation<B>,
    setup: &Setup,
    drift: bool,
    (states, every): (u32, u32),
) -> Box<dyn Series> {
    let mut series = begun(setup, &[("drift", Flag(drift))]).expect("a series");
    for _ in 0..states {
        simulation.step(every).expect("steps");
        let state = Arc::new(block_on(simulation.snapshot()).expect("a state"));
        series.take(&Moment { state: &state, density: &[], clock: None, links: None, virial: None }).expect("a row");
    }
    series
}

fn begun(setup: &Setup, sets: &[(&'static str, Value)]) -> Result<Box<dyn Series>, motes::Error> {
    let measure = measure("heat_capacity").expect("a measure");
    let settings = sets.iter().fold(Settings::defaults(measure.keys), |all, (key, value)| all.with(key, value.clone()));
    (measure.begin)(setup, &settings)
}

fn capacity(series: &dyn Series) -> &HeatCapacity {
    (series as &dyn Any).downcast_ref().expect("a heat capacity")
}

const KT: f64 = 1.3;

fn langevin(friction: f64, seed: f64) -> Box<dyn Component> {
    force("langevin", &[("temperature", Number(KT)), ("friction", Number(friction)), ("seed", Number(seed))])
}

fn bath(name: &'static str, seed: f64) -> Box<dyn Component> {
    force(name, &[("temperature", Number(KT)), ("seed", Number(seed))])
}

/// Points apart from each other, of different masses.
fn gas(count: u32) -> State {
    let mut state = State::default();
    (0..count).for_each(|k| state.push(DVec3::splat(f64::from(k)), DVec3::X, 1.0 + f64::from(k % 3), 0.0));
    state
}

/// 3/2 k for each particle within four of the errors that it gives, and these are 2 to 8 %: of 1200 states of a fluctuation that is independent after about one, whose
/// square is right to √(2 / 1200) = 4 %, over a factor of two for the error of an error.
#[test]
fn a_gas_in_a_bath_has_three_halves() {
    for (name, seed) in [("langevin", 1.0), ("langevin", 2.0), ("andersen", 3.0), ("csvr", 4.0)] {
        let mut setup = setup(gas(50), vec![bath(name, seed)], motes::Bounds::default(), 0.5);
        setup.state.velocity_mut().iter_mut().for_each(|v| *v = DVec3::ONE);
        let mut simulation = on_cpu(&setup);
        simulation.step(20).expect("steps");
        let series = measured(&mut simulation, &setup, true, (1200, 2));
        let capacity = capacity(&*series);
        assert_eq!(capacity.ensemble(), Ensemble::Bath(KT));
        let found = capacity.estimate().expect("an estimate");
        let error = found.error.expect("an error");
        println!("{name} {seed}: {} ± {error}", found.value);
        assert!((0.03..0.12).contains(&error), "{name}: {error}");
        assert!((found.value - 1.5).abs() < 4.0 * error, "{name}: {} ± {error}", found.value);
    }
}

/// Without forces the kinetic energy does not fluctuate: f / 2 k, here for N − 1 of N particles, to single precision.
#[test]
fn a_gas_at_constant_energy_has_its_degrees_of_freedom() {
    for (drift, left) in [(true, 50.0), (false, 49.0)] {
        let mut setup = setup(gas(50), vec![], motes::Bounds::default(), 0.5);
        setup.state.velocity_mut().iter_mut().zip(0..).for_each(|(v, k)| *v = DVec3::new(1.0, f64::from(k % 5), -1.0));
        let series = measured(&mut on_cpu(&setup), &setup, drift, (20, 1));
        let found = capacity(&*series).estimate().expect("an estimate");
        assert_eq!(capacity(&*series).ensemble(), Ensemble::Energy);
        assert!((found.value - 1.5 * left / 50.0).abs() < 1e-9, "{found:?}");
    }
}

/// Each atom on a spring of its own (Einstein 1907): 3 k. Leapfrog under `langevin` has ⟨x²⟩ = k T / (m ω² (1 − ω² dt² / 4)) and exact velocities,
/// so that potential energies fluctuate by 1 / (1 − ω² dt² / 4)² more: at ω dt = 0.3 3/2 (1 + 1.0465) = 3.07.
#[test]
fn a_crystal_of_oscillators_has_three() {
    for seed in [1.0, 2.0] {
        let mut state = State::default();
        for k in 0..60 {
            let x = DVec3::new(f64::from(k % 10), f64::from(k / 10), 0.0);
            (0..2).for_each(|_| state.push(x, DVec3::ZERO, 1.0, 0.0));
            state.held.push(Held { id: 2 * k, by: Hold::Fixed });
            state.links.springs.push(Link {
                ends: [2 * k, 2 * k + 1],
                rest: 0.0,
                stiffness: 1.0,
                damping: 0.0,
                rope: false,
            });
        }
        let setup = setup(state, vec![force("spring", &[]), langevin(1.0, seed)], motes::Bounds::default(), 0.3);
        let mut simulation = on_cpu(&setup);
        simulation.step(60).expect("steps");
        let series = measured(&mut simulation, &setup, true, (1500, 5));
        let found = capacity(&*series).estimate().expect("an estimate");
        let (error, want) = (found.error.expect("an error"), 1.5 * (1.0 + (1.0_f64 - 0.3 * 0.3 / 4.0).powi(-2)));
        println!("{} ± {error} for {want}", found.value);
        assert!((0.05..0.25).contains(&error), "{error}");
        assert!((found.value - want).abs() < 4.0 * error, "{} ± {error}", found.value);
    }
}

/// Kolafa & Nezbeda (Fluid Phase Equilib. 100, 1, 1994): the free energy of a Lennard-Jones particle, less that of an ideal gas.
fn free_energy(t: f64, density: f64) -> f64 {
    let root = t.sqrt();
    let diameter =
        0.011_117_524 / t - 0.076_383_859 / root + 1.080_142_248 + 0.000_693_129 * root - 0.063_920_968 * t.ln();
    let eta = std::f64::consts::PI / 6.0 * density * diameter.powi(3);
    let spheres =
        5.0 / 3.0 * (1.0 - eta).ln() + eta * (34.0 - 33.0 * eta + 4.0 * eta * eta) / (6.0 * (1.0 - eta).powi(2));
    let virial = [
        (-7, -0.585_449_78),
        (-6, 0.431_020_52),
        (-5, 0.873_613_69),
        (-4, -4.137_499_95),
        (-3, 2.906_162_79),
        (-2, -7.021_819_62),
        (0, 0.024_598_77),
    ];
    let virial: f64 = virial.iter().map(|(n, c)| c * root.powi(*n)).sum();
    let parts: [(i32, &[f64]); 4] = [
        (0, &[2.015_467_97, -28.178_816_36, 28.283_138_47, -10.424_028_73]),
        (-1, &[-19.583_716_55, 75.623_402_89, -120.705_865_98, 93.927_403_28, -27.377_373_54]),
        (-2, &[29.344_705_20, -112.353_569_37, 170.649_089_80, -123.066_691_87, 34.422_889_69]),
        (-4, &[-13.370_319_68, 65.380_595_70, -115.092_331_13, 88.919_730_82, -25.620_998_90]),
    ];
    let power = |c: &[f64]| c.iter().zip(2..).map(|(c, n)| c * density.powi(n)).sum::<f64>();
    let rest: f64 = parts.iter().map(|(n, c)| root.powi(*n) * power(c)).sum();
    t * (spheres + density * virial * (-1.929_072_78 * density * density).exp()) + rest
}

/// U = −T² d(F / T) / dT
fn energy(t: f64, density: f64) -> f64 {
    let h = 1e-3;
    let of = |t: f64| free_energy(t, density) / t;
    -t * t * (of(t + h) - of(t - h)) / (2.0 * h)
}

/// At constant energy, from two states of a liquid (T about 0.73): within four of the errors that it gives, a hundredth for N / (N − 1) and
/// the equation of state, which has the energies of NIST's Monte Carlo at T = 0.85 to 0.0016.
#[test]
#[ignore = "minutes on a software adapter: `tests/run --test physics --test commands -- --include-ignored` runs it"]
fn a_liquid_at_constant_energy_has_that_of_the_equation_of_state() {
    for (density, want) in [(0.776, -5.5121), (0.86, -6.0305), (0.9, -6.2391)] {
        assert!((energy(0.85, density) - want).abs() < 0.002, "{}", energy(0.85, density));
    }
    let (mut sum, mut weight) = (0.0, 0.0);
    for start in [40, 120] {
        let liquid = &*LIQUID;
        let mut state = State::default();
        let from = &liquid.states[start];
        let mean = from.velocity().iter().sum::<DVec3>() / from.len() as f64;
        (0..from.len()).for_each(|i| state.push(from.position()[i], from.velocity()[i] - mean, 1.0, 0.0));
        let setup = setup(state, vec![cut(RANGE, "shift", "list")], liquid.bounds, 0.004);
        let mut simulation = on_gpu(&setup);
        let series = measured(&mut simulation, &setup, false, (1000, 10));
        let capacity = capacity(&*series);
        assert_eq!((capacity.ensemble(), capacity.states()), (Ensemble::Energy, 1000));
        let found = capacity.estimate().expect("an estimate");
        let error = found.error.expect("an error");
        let t = capacity.temperature();
        let want = 1.5 + (energy(t + 0.003, DENSITY) - energy(t - 0.003, DENSITY)) / 0.006;
        println!("{} ± {error} for {want} at T = {t}", found.value);
        assert!(error < 0.3, "{error}");
        assert!((found.value - want).abs() < 4.0 * error + 0.01 * want, "{} ± {error} for {want}", found.value);
        sum += (found.value - want) / (error * error);
        weight += 1.0 / (error * error);
    }
    // Both together, which 3 k, that of a crystal, is not.
    let (mean, error) = (sum / weight, weight.sqrt().recip());
    println!("{mean} ± {error} off");
    assert!(mean.abs() < 4.0 * error + 0.03 && error < 0.15, "{mean} ± {error}");
}

#[test]
fn a_run_that_is_too_short_says_so() {
    let setup = setup(gas(50), vec![langevin(1.0, 5.0)], motes::Bounds::default(), 0.001);
    let mut simulation = on_cpu(&setup);
    for (states, words) in [(5, "the run is too short: 5 states count"), (40, "of the temperature of the bath")] {
        let series = measured(&mut simulation, &setup, true, (states, 1));
        let said = series.summary().expect("a line");
        // In 0.04 of a relaxation time the particles have hardly met the bath: energies only drift.
        let short = said.contains(words) || states > 5 && said.contains("without an error: the run is too short");
        assert!(short, "{said}");
        assert_eq!(capacity(&*series).estimate().ok().and_then(|one| one.error), None);
    }
}

/// Far from the bath there is no heat capacity, also where the run is too short for an error.
#[test]
fn a_gas_that_is_far_from_its_bath_has_none() {
    let mut hot = gas(50);
    hot.velocity_mut().iter_mut().for_each(|v| *v *= 4.0);
    let setup = setup(hot, vec![langevin(1.0, 5.0)], motes::Bounds::default(), 0.001);
    let series = measured(&mut on_cpu(&setup), &setup, true, (40, 1));
    let said = series.summary().expect("a line");
    assert!(said.contains("no heat capacity") && said.contains("of the temperature of the bath"), "{said}");
    assert!(capacity(&*series).estimate().is_err());
}

/// Friction beside a bath keeps particles cooler than it, and friction alone keeps no energy.
#[test]
fn states_of_no_ensemble_have_none() {
    for (more, words) in
        [(vec![langevin(1.0, 5.0)], "of the temperature of the bath"), (vec![], "the energy is not constant")]
    {
        let mut forces = vec![force("drag", &[("linear", Number(0.3))])];
        forces.extend(more);
        let setup = setup(gas(50), forces, motes::Bounds::default(), 0.1);
        let series = measured(&mut on_cpu(&setup), &setup, true, (200, 5));
        let said = series.summary().expect("a line");
        assert!(said.contains("no heat capacity") && said.contains(words), "{said}");
    }
}
