//! Springs against what is known of them: exact solutions, published numbers, and what must hold whatever they are.

#[path = "../support/mod.rs"]
mod support;

mod breaking;
mod chains;
mod invariants;
mod limits;
mod moduli;
mod pendulum;
mod sheets;
mod visits;

use glam::DVec3;
use motes::forces::Force;
use motes::links::Link;
use motes::motion::{Held, Hold};
use motes::particles::shape;
use motes::settings::{Settings, Value};
use motes::{Bounds, Gpu, Particles, Setup, Simulation};
use support::Shared;
use support::states::{force, integrator, vector};

/// A spring without damping.
pub fn spring(ends: [u32; 2], rest: f64, stiffness: f64) -> Link {
    Link { ends, rest, stiffness, damping: 0.0, rope: false }
}

/// Springs, and weight along z unless it is zero; and some drag.
pub fn forces(weight: f64, drag: f64) -> Vec<Box<dyn Force>> {
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
pub fn at(places: &[[f64; 3]], mass: f64) -> Particles {
    let mut particles = Particles::default();
    places.iter().for_each(|x| particles.push(DVec3::from(*x), DVec3::ZERO, mass, 0.0));
    particles
}

/// Fixes some of them.
pub fn fix(particles: &mut Particles, ids: impl IntoIterator<Item = u32>) {
    particles.held.extend(ids.into_iter().map(|id| Held { id, by: Hold::Fixed }));
}

/// A shape with some settings.
pub fn made(name: &str, settings: &[(&'static str, Value)]) -> Particles {
    let shape = shape(name).expect("a shape");
    let settings = settings.iter().fold(Settings::defaults(shape.keys), |s, (key, value)| s.with(key, value.clone()));
    (shape.build)(&settings).expect("particles")
}

/// What runs on the device.
pub fn setup(particles: &Particles, forces: Vec<Box<dyn Force>>, name: &str, dt: f64) -> Setup {
    Setup {
        particles: particles.clone(),
        forces,
        integrator: integrator(name),
        dt,
        bounds: Bounds::default(),
        solver: motes::Solver::default(),
    }
}

/// The same, made.
pub fn gpu(shared: &Shared, setup: &Setup) -> Simulation<Gpu> {
    Simulation::new(&shared.found.device, &shared.found.queue, setup).expect("a simulation")
}
