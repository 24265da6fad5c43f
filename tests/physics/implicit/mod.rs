//! Implicit integrators: what they do to stiff laws, and how their linear systems are solved.

#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

mod cloth;
mod growth;
mod idle;
mod pendulum;
mod references;
mod solves;

use crate::support::Shared;
use crate::support::states::integrator;
use glam::DVec3;
use motes::forces::Component;
use motes::kernel::Backend;
use motes::links::Link;
use motes::motion::{Held, Hold};
use motes::{Bounds, Cpu, Gpu, POSITION, Setup, Simulation, Solver, State, VELOCITY};

/// The three methods, each in its linear and its converged form.
const ALL: [&str; 6] = [
    "linear_backward_euler",
    "backward_euler",
    "linear_trapezoid",
    "trapezoid",
    "linear_implicit_midpoint",
    "implicit_midpoint",
];

fn setup(particles: &State, forces: Vec<Box<dyn Component>>, name: &str, dt: f64, solver: Solver) -> Setup {
    Setup { state: particles.clone(), forces, integrator: integrator(name), dt, bounds: Bounds::default(), solver }
}

fn on_device(shared: &Shared, setup: &Setup) -> Simulation<Gpu> {
    Simulation::new(&shared.found.device, &shared.found.queue, setup).expect("a simulation")
}

fn on_references(setup: &Setup) -> Simulation<Cpu> {
    let count = u32::try_from(setup.state.len()).expect("few");
    Simulation::on(Cpu::new(count).expect("some"), setup).expect("a simulation")
}

/// Position and velocity of a particle.
fn phase<B: Backend>(simulation: &mut Simulation<B>, id: usize) -> (DVec3, DVec3) {
    let vector = |values: Vec<glam::Vec4>| values[id].truncate().as_dvec3();
    let x = pollster::block_on(simulation.read(POSITION)).expect("positions");
    let v = pollster::block_on(simulation.read(VELOCITY)).expect("velocities");
    (vector(x), vector(v))
}

/// Ties two particles by a spring.
fn tie(particles: &mut State, ends: [u32; 2], rest: f64, stiffness: f64, damping: f64) {
    particles.links.springs.push(Link { ends, rest, stiffness, damping, rope: false });
}

fn hold(particles: &mut State, id: u32) {
    particles.held.push(Held { id, by: Hold::Fixed });
}
