//! Columns that integrators advance by their rates: orders, lockstep, fixed and inactive particles, rigid bodies, refusals.
#![allow(clippy::cast_sign_loss, clippy::cast_possible_truncation, reason = "numbers of steps are small")]

mod elliptic;
mod lockstep;
mod orders;
mod refusals;
mod tops;

use crate::support::states::integrator;
use motes::forces::Component;
use motes::kernel::Array;
use motes::{Bounds, Cpu, Setup, Simulation, State};

fn setup(state: &State, forces: Vec<Box<dyn Component>>, name: &str, dt: f64) -> Setup {
    Setup {
        state: state.clone(),
        forces,
        integrator: integrator(name),
        dt,
        bounds: Bounds::default(),
        solver: motes::Solver::default(),
    }
}

/// The same, where the columns begin so.
fn beginning(state: &State, columns: &[(&str, Array)]) -> State {
    let mut state = state.clone();
    columns.iter().for_each(|(name, values)| state.set(name, values.clone()).expect("values"));
    state
}

/// A simulation by the references.
fn by_references(setup: &Setup) -> Simulation<Cpu> {
    let count = u32::try_from(setup.state.len()).expect("few");
    Simulation::on(Cpu::new(count).expect("some"), setup).expect("a simulation")
}

fn column(simulation: &mut Simulation<Cpu>, name: &str) -> Array {
    simulation.backend().host().get(name).unwrap_or_else(|| panic!("no column `{name}`"))
}
