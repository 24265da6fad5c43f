//! Fluids: what smooths them, what they feel, and what they do, against quadrature, twins, series and published numbers.

#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

#[path = "../support/mod.rs"]
mod support;

mod invariants;
mod lockstep;
mod smoothing;
mod walls;

use motes::forces::Force;
use motes::{Bounds, Gpu, Particles, Setup, Simulation};
use support::Shared;
use support::states::integrator;

fn setup(particles: &Particles, forces: Vec<Box<dyn Force>>, name: &str, dt: f64, bounds: Bounds) -> Setup {
    Setup {
        particles: particles.clone(),
        forces,
        integrator: integrator(name),
        dt,
        bounds,
        solver: motes::Solver::default(),
    }
}

fn gpu(shared: &Shared, setup: &Setup) -> Simulation<Gpu> {
    Simulation::new(&shared.found.device, &shared.found.queue, setup).expect("a simulation")
}
