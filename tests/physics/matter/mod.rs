//! Ions, grains and a thermostat: closed forms, published numbers, and every kernel against its reference in states that suit it.
#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "numbers are rounded to what f32 holds, and counts are small"
)]
#![allow(clippy::float_cmp, reason = "what does nothing is 0 to the bit")]

mod bridges;
mod collapse;
mod energy;
mod flows;
mod grains;
mod ions;
mod parted;
mod stress;
mod thermostat;
mod walls;

use std::path::PathBuf;

use crate::support::states::integrator;
use glam::DVec3;
use motes::forces::Component;
use motes::kernel::{Array, Plan};
use motes::lockstep::compare;
use motes::scene::{Options, Scene, Source};
use motes::{Bounds, Cpu, Setup, Simulation, Solver, State};

/// Particles on a lattice that is a little disordered, so that no two are close, of three species, with masses about 1.
pub fn spread(count: usize, spacing: f64) -> State {
    let mut random = crate::support::Random::new(17);
    let mut state = State::default();
    let side = side(count);
    for i in 0..count {
        let cell = DVec3::new((i % side) as f64, (i / side % side) as f64, (i / side / side) as f64);
        let x = spacing * (cell + 0.15 * random.vector());
        let single = |v: DVec3| v.as_vec3().as_dvec3();
        let mass = f64::from((1.0 + 0.3 * random.next()) as f32);
        state.push(single(x), single(0.3 * random.vector()), mass, 0.01);
    }
    state.species_mut().copy_from_slice(&crate::support::species(count));
    state
}

/// How many along a side of a cube hold so many.
pub fn side(count: usize) -> usize {
    (1..=count).find(|side| side.pow(3) >= count).expect("a side")
}

fn scalars(count: usize, seed: u64, of: impl Fn(f64) -> f64) -> Array {
    let mut random = crate::support::Random::new(seed);
    Array::Float((0..count).map(|_| f64::from(of(random.next()) as f32)).collect())
}

fn setup(state: State, forces: Vec<Box<dyn Component>>, bounds: Bounds, dt: f64) -> Setup {
    Setup { state, forces, integrator: integrator("leapfrog"), dt, bounds, solver: Solver::default() }
}

pub fn on_cpu(setup: &Setup) -> Simulation<Cpu> {
    Simulation::on(Cpu::new(setup.check().expect("a setup")).expect("some"), setup).expect("a simulation")
}

/// States of a built-in scene on the device, at these steps.
pub fn states_of(name: &str, overrides: &[String], at: &[u32]) -> Vec<State> {
    let scene = motes::scene::SCENES.iter().find(|scene| scene.name == name).expect("a built-in scene");
    states(scene.text.to_owned(), overrides, at)
}

/// States of the text of a scene on the device, at these steps.
pub fn states(text: String, overrides: &[String], at: &[u32]) -> Vec<State> {
    let source = Source::Text { name: "grains.toml".to_owned(), text, folder: PathBuf::from(".") };
    let scene = Scene::load(&source, overrides, &Options::default()).unwrap_or_else(|faults| panic!("{faults}"));
    let setup = crate::support::scenes::setup(scene);
    let shared = crate::support::device();
    let mut simulation = Simulation::new(&shared.found.device, &shared.found.queue, &setup).expect("a simulation");
    let mut done = 0;
    let mut state = |step: &u32| {
        simulation.step(step - done).expect("steps");
        done = *step;
        pollster::block_on(simulation.snapshot()).expect("a state")
    };
    at.iter().map(&mut state).collect()
}

/// Every kernel of the steps of a setup on the device agrees with its reference, some steps long; what the kernels of these names
/// write changes. `slack` is how many times what is allowed elsewhere may be wrong.
pub fn agrees(setup: &Setup, steps: u32, slack: f64, busy: &[&str]) {
    let shared = crate::support::device();
    let count = setup.state.len();
    let gpu = crate::support::machines::gpu(&shared, count);
    let mut simulation = Simulation::on(gpu, setup).expect("a simulation");
    let plan: Plan = setup.plans(motes::kernel::Backend::machine(simulation.backend())).expect("plans").step;
    for step in 0..steps {
        simulation.step(1).expect("a step");
        let verdicts =
            pollster::block_on(compare(simulation.backend(), &plan, setup.state.len() as u32)).expect("verdicts");
        for verdict in &verdicts {
            assert!(verdict.conditioned <= slack && !verdict.spilled, "{count} particles, step {step}: {verdict:?}");
        }
        for name in busy {
            let mut its = verdicts.iter().filter(|verdict| verdict.kernel.starts_with(name));
            assert!(its.any(|verdict| verdict.changed), "{count} particles, step {step}: {name} does nothing");
        }
    }
    pollster::block_on(simulation.check()).expect("no alarm");
}
