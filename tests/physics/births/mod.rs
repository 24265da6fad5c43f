//! Which particles are spawned when and where, which are removed, and that inactive ones act on no other.

mod adaptive;
mod files;
mod ledger;
mod lockstep;
mod refusals;
mod schedule;
mod spawn;

use crate::support::states::{force, integrator, word};
use glam::DVec3;
use motes::forces::Component;
use motes::kernel::Backend;
use motes::life::Drain;
use motes::settings::{Settings, Value};
use motes::shapes::emitter;
use motes::{Bounds, Setup, Side, Simulation, State};

/// No round number, and no part of an interval between two births.
const DT: f64 = 0.0137;

/// The particles of an emitter with these settings, until some end.
fn emitted(settings: &[(&'static str, Value)], dimensions: u32, end: f64) -> State {
    let defaults = Settings::defaults(emitter::KEYS);
    let settings = settings.iter().fold(defaults, |s, (key, value)| s.with(key, value.clone()));
    emitter::build(&settings, dimensions, end, 100_000).expect("an emitter")
}

/// A mouth of three rows by two, at an angle.
fn jet(end: f64) -> State {
    let settings = [
        ("shape", word("rectangle")),
        ("size", Value::Vector(DVec3::new(0.3, 0.2, 0.0))),
        ("center", Value::Vector(DVec3::new(0.1, -0.2, 0.3))),
        ("direction", Value::Vector(DVec3::new(2.0, -1.0, 2.0))),
        ("speed", Value::Number(1.3)),
        ("spacing", Value::Number(0.1)),
    ];
    emitted(&settings, 3, end)
}

/// A spray of a disk, in a cone.
fn spray(end: f64) -> State {
    let settings = [
        ("radius", Value::Number(0.2)),
        ("direction", Value::Vector(DVec3::Y)),
        ("speed", Value::Number(0.9)),
        ("rate", Value::Number(71.0)),
        ("start", Value::Number(0.1)),
        ("spread", Value::Number(20.0)),
        ("mass", Value::Number(0.03)),
    ];
    emitted(&settings, 3, end)
}

/// What is to run.
fn setup(particles: State, forces: Vec<Box<dyn Component>>, bounds: Bounds) -> Setup {
    Setup {
        state: particles,
        forces,
        integrator: integrator("leapfrog"),
        dt: DT,
        bounds,
        solver: motes::Solver::default(),
    }
}

/// A fluid of that spacing in the plane, slow enough for [`DT`].
fn fluid() -> Box<dyn Component> {
    fluid_with(&[])
}

/// The same, and some more.
fn fluid_with(more: &[(&'static str, Value)]) -> Box<dyn Component> {
    let known =
        [("spacing", 0.1), ("sound_speed", 2.0), ("alpha", 0.1)].map(|(key, value)| (key, Value::Number(value)));
    force("fluid", &[&known, more].concat())
}

/// A pool in the plane, a jet into it, and a drain in which some of both die; mirrors around.
fn pool(drains: Vec<Drain>) -> Setup {
    let block = motes::shapes::shape("block").expect("a shape");
    let settings = Settings::defaults(block.keys)
        .with("size", Value::Vector(DVec3::new(1.2, 0.5, 0.0)))
        .with("spacing", Value::Number(0.1))
        .with("jitter", Value::Number(0.1))
        .with("center", Value::Vector(DVec3::new(0.6, 0.26, 0.0)));
    let mut particles = (block.build)(&settings).expect("a block");
    let settings = [
        ("shape", word("rectangle")),
        ("size", Value::Vector(DVec3::new(0.3, 0.3, 0.0))),
        ("center", Value::Vector(DVec3::new(0.4, 1.1, 0.0))),
        ("direction", Value::Vector(DVec3::new(1.0, -2.0, 0.0))),
        ("speed", Value::Number(1.1)),
        ("spacing", Value::Number(0.1)),
    ];
    particles.append(&emitted(&settings, 2, 1.2)).expect("one kind");
    particles.drains = drains;
    let forces = vec![
        force("uniform", &[("acceleration", Value::Vector(DVec3::new(0.0, -1.3, 0.0)))]),
        fluid(),
        force("solid", &[("radius", Value::Number(0.2)), ("position", Value::Vector(DVec3::new(1.0, 0.1, 0.0)))]),
    ];
    let mut bounds = Bounds::new(DVec3::ZERO, DVec3::new(1.4, 3.0, 0.0), Side::Reflecting);
    bounds.dimensions = 2;
    setup(particles, forces, bounds)
}

/// The state of a simulation, for a moment.
fn state<B: Backend>(simulation: &mut Simulation<B>) -> motes::State {
    pollster::block_on(simulation.snapshot()).expect("a state")
}
