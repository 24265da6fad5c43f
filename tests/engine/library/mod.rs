//! What a program that uses the library relies on.

mod diagnose;
mod examples;
mod misuse;
mod readback;
mod set;
mod subgroups;
mod threads;

use motes::forces::Component;
use motes::{Bounds, Gpu, Setup, Simulation, Solver, State};

use crate::support::Shared;
use crate::support::states::integrator;

/// A setup in open space.
fn setup(state: State, forces: Vec<Box<dyn Component>>) -> Setup {
    let (bounds, solver) = (Bounds::default(), Solver::default());
    Setup { state, forces, integrator: integrator("leapfrog"), dt: 0.01, bounds, solver }
}

fn on_gpu(shared: &Shared, setup: &Setup) -> Simulation<Gpu> {
    Simulation::new(&shared.found.device, &shared.found.queue, setup).expect("a simulation")
}
