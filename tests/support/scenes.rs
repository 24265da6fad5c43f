//! Built-in scenes with few particles, and what simulations of them are made of.

use motes::Setup;
use motes::integrators::Adaptive;
use motes::scene::{Options, SCENES, Scene, Source};

/// Particles of a shape, where a scene is made small.
const FEW: usize = 200;

/// A built-in scene with few particles of every shape that has a count.
pub fn small(name: &str) -> Scene {
    let text = SCENES.iter().find(|scene| scene.name == name).expect("a built-in scene").text;
    let mut overrides = Vec::new();
    for (i, shape) in text.split("[[particles]]").skip(1).enumerate() {
        let lines = || shape.lines().take_while(|line| !line.starts_with('['));
        let has = |key: &str| lines().filter_map(|line| line.split_once('=')).any(|(k, _)| k.trim() == key);
        let count = lines().filter_map(|line| line.split_once('=')).find(|(key, _)| key.trim() == "count");
        let count = count.and_then(|(_, value)| value.split_whitespace().next()?.parse::<usize>().ok());
        if count.is_some_and(|count| count > FEW) {
            overrides.push(format!("particles.{i}.count={FEW}"));
        }
        if has("columns") {
            overrides.extend([format!("particles.{i}.columns=12"), format!("particles.{i}.rows=9")]);
        }
    }
    if name == "periodic_box" {
        overrides.push("particles.0.size=[8, 8, 8]".to_owned());
    }
    let overrides: Vec<_> = overrides.iter().map(String::as_str).collect();
    with(name, &overrides)
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
