//! Built-in scenes with few particles, and what simulations of them are made of.

use motes::Setup;
use motes::integrators::Adaptive;
use motes::scene::{Options, Scene, Source};

use super::small::smaller;

/// A built-in scene with few particles.
pub fn small(name: &str) -> Scene {
    with(name, smaller(name))
}

/// What a simulation of a scene is made of.
pub fn setup(scene: Scene) -> Setup {
    Setup {
        integrator: match scene.adaptive_step {
            Some(adaptive_step) => Box::new(Adaptive { integrator: scene.integrator(), adaptive_step }),
            None => scene.integrator(),
        },
        state: scene.particles,
        forces: scene.forces,
        dt: scene.dt,
        bounds: scene.bounds,
        solver: scene.solver,
    }
}

/// A built-in scene with some values set.
pub fn with(name: &str, overrides: &[&str]) -> Scene {
    let overrides: Vec<_> = overrides.iter().map(|text| (*text).to_owned()).collect();
    let source = Source::find(name).expect("a built-in scene");
    Scene::load(&source, &overrides, &Options::default()).unwrap_or_else(|faults| panic!("{name}: {faults}"))
}
