//! Springs against what is known of them: exact solutions, published numbers, and what must hold whatever they are.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "numbers are rounded to what f32 holds, and ids are few"
)]

mod beams;
mod breaking;
mod chains;
mod invariants;
mod limits;
mod moduli;
mod pendulum;
mod sheets;
mod visits;

use crate::support::Shared;
use crate::support::states::{force, integrator, vector};
use glam::DVec3;
use motes::forces::Component;
use motes::links::Link;
use motes::motion::{Held, Hold};
use motes::settings::{Settings, Value};
use motes::shapes::shape;
use motes::{Bounds, Gpu, Setup, Simulation, State};

/// A spring without damping.
fn spring(ends: [u32; 2], rest: f64, stiffness: f64) -> Link {
    Link { ends, rest, stiffness, damping: 0.0, rope: false }
}

/// Springs, and weight along z unless it is zero; and some drag.
fn forces(weight: f64, drag: f64) -> Vec<Box<dyn Component>> {
    let mut all = vec![force("spring", &[])];
    if weight > 0.0 {
        all.push(force("uniform", &[("acceleration", vector(0.0, 0.0, -weight))]));
    }
    if drag > 0.0 {
        all.push(force("drag", &[("linear", Value::Number(drag))]));
    }
    all
}

/// Particles at rest.
fn at(places: &[[f64; 3]], mass: f64) -> State {
    let mut particles = State::default();
    for x in places {
        particles.push(DVec3::from(*x), DVec3::ZERO, mass, 0.0);
    }
    particles
}

/// Fixes some of them.
fn fix(particles: &mut State, ids: impl IntoIterator<Item = u32>) {
    particles.held.extend(ids.into_iter().map(|id| Held { id, by: Hold::Fixed }));
}

/// A shape with some settings.
fn made(name: &str, settings: &[(&'static str, Value)]) -> State {
    let shape = shape(name).expect("a shape");
    let settings = settings.iter().fold(Settings::defaults(shape.keys), |s, (key, value)| s.with(key, value.clone()));
    (shape.build)(&settings).expect("particles")
}

/// What runs on the device.
fn setup(particles: &State, forces: Vec<Box<dyn Component>>, name: &str, dt: f64) -> Setup {
    Setup {
        state: particles.clone(),
        forces,
        integrator: integrator(name),
        dt,
        bounds: Bounds::default(),
        solver: motes::Solver::default(),
    }
}

/// The same, made.
fn gpu(shared: &Shared, setup: &Setup) -> Simulation<Gpu> {
    Simulation::new(&shared.found.device, &shared.found.queue, setup).expect("a simulation")
}
