//! Energies of NIST's sample configurations of Lennard-Jones atoms.

use glam::DVec3;
use motes::State;

use super::{cut, periodic};
use crate::support::states::accelerations_in;

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
