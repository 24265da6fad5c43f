//! Fluids: what smooths them, their forces, and what they do, against quadrature, references, series and published numbers.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "numbers are rounded to what f32 holds, and numbers of steps are above 0"
)]

mod channels;
mod columns;
mod continuity;
mod drops;
mod friction;
mod invariants;
mod keys;
mod laplace;
mod listed;
mod lockstep;
mod rates;
mod regime;
mod smoothing;
mod tension;
mod turning;
mod vortices;
mod walls;

use crate::support::Shared;
use crate::support::states::integrator;
use glam::DVec3;
use motes::forces::Component;
use motes::scene::{Options, Scene, Source};
use motes::{Bounds, Gpu, POSITION, Setup, Simulation, State, VELOCITY};

fn setup(particles: &State, forces: Vec<Box<dyn Component>>, name: &str, dt: f64, bounds: Bounds) -> Setup {
    Setup {
        state: particles.clone(),
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

/// A scene of the program with some changes, and its setup.
fn scene(name: &str, changes: &[&str]) -> (Scene, Setup) {
    let changes: Vec<_> = changes.iter().map(|text| (*text).to_owned()).collect();
    let load = || {
        let source = Source::find(name).expect("a scene of the program");
        Scene::load(&source, &changes, &Options::default()).unwrap_or_else(|faults| panic!("{faults}"))
    };
    let parts = load();
    let integrator = parts.integrator();
    let setup = Setup {
        state: parts.particles,
        forces: parts.forces,
        integrator,
        dt: parts.dt,
        bounds: parts.bounds,
        solver: motes::Solver::default(),
    };
    (load(), setup)
}

/// Where the particles are, and how they move.
fn state(simulation: &mut Simulation<Gpu>) -> Vec<(DVec3, DVec3)> {
    let read = |simulation: &mut Simulation<Gpu>, field| pollster::block_on(simulation.read(field)).expect("a field");
    let (x, v) = (read(simulation, POSITION), read(simulation, VELOCITY));
    x.iter().zip(v).map(|(x, v)| (x.truncate().as_dvec3(), v.truncate().as_dvec3())).collect()
}
