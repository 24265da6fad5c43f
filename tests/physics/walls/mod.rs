//! What fluids stand in: walls of particles at the gap that leaves a fluid at rest, starts that are refused, no leaks,
//! and a dam that breaks as measured.

mod calm;
mod contradictions;
mod dam;
mod gaps;
mod leaks;
mod meshes;
mod remarks;
mod shapes;
mod starts;

use std::path::PathBuf;

use glam::DVec3;
use motes::State;
use motes::scene::{Diagnostics, Options, Scene, Source};
use motes::settings::{Settings, Value};
use motes::shapes::shape;
use motes::{Gpu, POSITION, Setup, Simulation};

/// A shape by its settings.
fn made(name: &str, values: &[(&'static str, Value)]) -> Result<State, motes::Error> {
    let shape = shape(name).expect("a shape");
    let start = Settings::defaults(shape.keys);
    let settings = values.iter().fold(start, |all, (key, value)| all.with(key, value.clone()));
    (shape.build)(&settings)
}

fn number(x: f64) -> Value {
    Value::Number(x)
}

fn vector(x: f64, y: f64, z: f64) -> Value {
    Value::Vector(DVec3::new(x, y, z))
}

fn word(text: &str) -> Value {
    Value::Text(text.to_owned().into())
}

fn load(text: &str) -> Result<Scene, Diagnostics> {
    let folder = PathBuf::from("tests/physics/walls");
    Scene::load(&Source::Text { name: "a.toml".to_owned(), text: text.to_owned(), folder }, &[], &Options::default())
}

fn setup_of(mut scene: Scene) -> Setup {
    scene.setup()
}

/// The setup of a scene's text.
fn setup(text: &str) -> Setup {
    setup_of(load(text).unwrap_or_else(|faults| panic!("{faults}")))
}

/// A built-in scene with some values set.
fn builtin(name: &str, overrides: &[&str]) -> Setup {
    let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
    let source = Source::find(name).expect("a built-in scene");
    setup_of(Scene::load(&source, &overrides, &Options::default()).unwrap_or_else(|faults| panic!("{faults}")))
}

/// Places of all, every so many steps, until `look` has seen enough.
fn watched(setup: &Setup, every: u32, mut look: impl FnMut(f64, &[DVec3]) -> bool) {
    let shared = crate::support::device();
    let gpu = Gpu::new(&shared.found.device, &shared.found.queue, setup.check().expect("a setup")).expect("room");
    let mut simulation = Simulation::on(gpu, setup).expect("a simulation");
    loop {
        simulation.step(every).expect("steps");
        pollster::block_on(simulation.check()).unwrap_or_else(|why| panic!("{why}"));
        let read = pollster::block_on(simulation.read(POSITION)).expect("positions");
        let places: Vec<DVec3> = read.iter().map(|x| x.truncate().as_dvec3()).collect();
        #[expect(clippy::cast_precision_loss, reason = "few steps")]
        if !look(simulation.steps() as f64 * setup.dt, &places) {
            return;
        }
    }
}
