//! Energies of NIST's sample configurations of Lennard-Jones atoms.

use std::sync::Arc;

use glam::DVec3;
use motes::forces::Component;
use motes::measure::{Cell, Moment, measure};
use motes::settings::{Pair, Settings, Value};
use motes::{Bounds, State};

use super::{cut, lennard_jones, periodic, setup};
use crate::support::states::{accelerations_in, word};

/// NIST's fourth sample configuration: 30 atoms in a cube of side 8 (NIST Standard Reference Simulation Website, SRD 173, Lennard-Jones
/// fluid reference calculations, cuboid cell).
const CONFIGURATION: &str = include_str!("lj_sample_config_4.csv");

pub fn atoms() -> State {
    let mut state = State::default();
    for line in CONFIGURATION.lines().skip(1) {
        let x: Vec<f64> = line.split(',').map(|word| word.parse().expect("a number")).collect();
        state.push(DVec3::new(x[0], x[1], x[2]), DVec3::ZERO, 1.0, 0.0);
    }
    assert_eq!(state.len(), 30);
    state
}

/// The table has five digits; LAMMPS' `lj/smooth/linear` has the last.
#[test]
fn a_configuration_has_the_energies_of_nist() {
    let bounds = periodic(DVec3::splat(-4.0), DVec3::splat(4.0));
    let energy = |range: f64, truncation: &'static str| -> f64 {
        accelerations_in(&bounds, &[cut(range, truncation, "within")], &atoms(), 0.0).iter().map(|a| a.w).sum()
    };
    for (range, truncation, known) in [(3.0, "cut", -16.790), (4.0, "cut", -17.060), (3.0, "force_shift", -15.001)] {
        let got = energy(range, truncation);
        assert!((got - known).abs() < 6e-4, "{range}, {truncation}: {got} is not {known}");
    }
}

/// A row of the measure `tail`: energy, that of a particle, and pressure.
fn corrections(state: &State, bounds: Bounds, law: Box<dyn Component>) -> Result<Vec<f64>, motes::Error> {
    let setup = setup(state.clone(), vec![law], bounds, 1e-3);
    let mut series = (measure("tail").expect("a measure").begin)(&setup, &Settings::default())?;
    let state = Arc::new(state.clone());
    let rows = series.take(&Moment { state: &state, density: &[], clock: None, links: None, virial: None })?;
    let number = |cell: &Cell| if let Cell::Number(x) = cell { *x } else { f64::NAN };
    Ok(rows[0].iter().map(number).collect())
}

/// NIST gives the long-range corrections of the energy of that configuration to five digits: −0.54517 and −0.23008. The pressure by hand, 16/3
/// π ρ² (2/3 R⁻⁹ − R⁻³); and all pairs of two species that are alike are those of one.
#[test]
fn a_configuration_has_the_long_range_corrections_of_nist() {
    let bounds = periodic(DVec3::splat(-4.0), DVec3::splat(4.0));
    let mut state = atoms();
    let density = 30.0 / 512.0;
    let mut both = Vec::new();
    for (range, known) in [(3.0_f64, -0.54517), (4.0, -0.23008)] {
        let got = corrections(&state, bounds, cut(range, "cut", "within")).expect("corrections");
        assert!(
            (got[0] - known).abs() < 6e-6 && (got[1] - known / 30.0).abs() < 6e-6,
            "{range}: {got:?} is not {known}"
        );
        let pressure =
            16.0 / 3.0 * std::f64::consts::PI * density * density * (2.0 / 3.0 * range.powi(-9) - range.powi(-3));
        assert!((got[2] / pressure - 1.0).abs() < 1e-9, "{range}: {got:?} is not {pressure}");
        both.push(got);
    }
    let one = |epsilon: f64, sigma: f64| vec![("epsilon".to_owned(), epsilon), ("sigma".to_owned(), sigma)];
    let pairs = |other: [f64; 2]| {
        let pair = |species, [epsilon, sigma]: [f64; 2]| Pair { species, values: one(epsilon, sigma) };
        Value::Pairs(vec![pair([0, 0], [1.0, 1.0]), pair([1, 0], other), pair([1, 1], [1.0, 1.0])])
    };
    let law = |other: [f64; 2]| {
        lennard_jones(&[("range", Value::Number(3.0)), ("truncation", word("cut")), ("pairs", pairs(other))])
    };
    state.species_mut()[..10].fill(1);
    let alike = corrections(&state, bounds, law([1.0, 1.0])).expect("corrections");
    assert!(alike.iter().zip(&both[0]).all(|(a, b)| (a / b - 1.0).abs() < 1e-12), "{alike:?} {:?}", both[0]);
    // 2 · 10 · 20 of 900 pairs are unlike.
    let deeper = corrections(&state, bounds, law([2.0, 1.0])).expect("corrections");
    assert!((deeper[0] / both[0][0] - (1.0 + 400.0 / 900.0)).abs() < 1e-12, "{deeper:?}");
    for truncation in ["shift", "force_shift", "xplor"] {
        let refused = corrections(&state, bounds, cut(3.0, truncation, "within")).expect_err("nothing to correct");
        assert!(refused.to_string().contains("truncation = \"cut\""), "{refused}");
    }
    let open = Bounds::default();
    assert!(corrections(&state, open, cut(3.0, "cut", "within")).is_err());
}
