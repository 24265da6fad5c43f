//! Steps that are too long for a force are noticed while numbers are still numbers; what merely grows is left alone.

use crate::support::states::{cpu, force, integrator, one, word};
use crate::support::{Random, Shared};
use glam::DVec3;
use motes::forces::Component;
use motes::scene::{Options, Scene, Source};
use motes::settings::Value;
use motes::{Cpu, Error, Setup, Simulation, State};
use pollster::block_on;

fn spring(strength: f64) -> Vec<Box<dyn Component>> {
    vec![force("attractor", &[("profile", word("harmonic")), ("strength", Value::Number(strength))])]
}

fn on_device(shared: &Shared, particles: &State, strength: f64, name: &str, dt: f64) -> Simulation<motes::Gpu> {
    let setup = Setup {
        state: particles.clone(),
        forces: spring(strength),
        integrator: integrator(name),
        dt,
        bounds: motes::Bounds::default(),
        solver: motes::Solver::default(),
    };
    Simulation::new(&shared.found.device, &shared.found.queue, &setup).expect("a simulation")
}

/// The particle and the step of a runaway.
fn runaway(result: Result<(), Error>) -> Option<(u32, u64)> {
    match result {
        Ok(()) => None,
        Err(Error::Runaway { particle, step }) => Some((particle, step)),
        Err(other) => panic!("{other}"),
    }
}

/// A step a little beyond the limit; the same step and particle, however the steps are put together, on device and references.
#[test]
fn too_long_a_step_is_noticed() {
    let shared = crate::support::device();
    // The second particle starts the farthest out, and is the first that is too fast.
    let mut particles = State::default();
    for x in [0.2, 1.0, 0.5] {
        particles.push(DVec3::new(0.1 * x, x, 0.0), DVec3::ZERO, 1.0, 0.0);
    }
    for (name, y) in
        [("leapfrog", 2.02), ("symplectic_euler", 2.02), ("forward_euler", 0.4), ("rk4", 2.9), ("pefrl", 2.995)]
    {
        let mut references = cpu(&particles, spring(1.0), name, y);
        let mut seen = None;
        for step in 0..400 {
            references.step(1).expect("a step");
            if let Some(found) = runaway(block_on(references.check())) {
                assert_eq!(found.1, step, "{name}: it is reported in the step in which it is seen");
                seen = Some(found);
                break;
            }
        }
        let Some((1, step)) = seen else { panic!("{name}: {seen:?}") };
        // Seven windows of growth, each of 16 steps, and the eighth to compare them with; a little more where a wave's
        // phase hides the growth for a while.
        assert!((112..400).contains(&step), "{name}: step {step}");
        for batch in [1, 7, 400] {
            let mut device = on_device(&shared, &particles, 1.0, name, y);
            let mut found = None;
            for _ in (0..400).step_by(batch as usize) {
                device.step(batch).expect("steps");
                // In the end nothing is finite, and what came first is reported.
                found = found.or(runaway(block_on(device.check())));
                if found.is_some() {
                    break;
                }
            }
            assert_eq!(found, Some((1, step)), "{name} in batches of {batch}");
        }
        // The snapshot is what is there: a user may want it.
        assert!(block_on(references.snapshot()).is_ok());
    }
}

/// Just below the limit speeds are high, and stay.
#[test]
fn what_stays_is_left_alone() {
    for (name, y) in
        [("leapfrog", 1.99), ("symplectic_euler", 1.99), ("rk4", 2.8), ("pefrl", 2.98), ("forward_euler", 0.05)]
    {
        let mut references = cpu(&one(DVec3::new(1.0, 0.3, -0.2), DVec3::ZERO), spring(1.0), name, y);
        for _ in 0..20 {
            references.step(100).expect("steps");
            assert_eq!(runaway(block_on(references.check())), None, "{name}");
        }
    }
}

/// A fall from rest, with and without drag; a ball that collapses upon itself, with so little softening that encounters are
/// violent; and a swing from the very top, which grows by e^(t √(g/L)) for long.
#[test]
fn what_grows_for_a_reason_is_left_alone() {
    let weight = || force("uniform", &[("acceleration", Value::Vector(DVec3::NEG_Z * 9.81))]);
    let fall: Vec<Box<dyn Component>> = vec![weight()];
    let drag: Vec<Box<dyn Component>> = vec![weight(), force("drag", &[("linear", Value::Number(0.1))])];
    let mut random = Random::new(3);
    let mut ball = State::default();
    while ball.len() < 60 {
        let x = random.vector();
        if x.length() < 1.0 {
            ball.push(x, DVec3::ZERO, 1.0 / 60.0, 0.0);
        }
    }
    let gravity: Vec<Box<dyn Component>> = vec![force("gravity", &[("softening", Value::Number(1e-3))])];
    // Away from a hill, from almost the top of it.
    let hill: Vec<Box<dyn Component>> = spring(-1.0);
    let top = one(DVec3::X * 1e-9, DVec3::ZERO);
    let start = one(DVec3::ZERO, DVec3::ZERO);
    for (what, particles, forces, dt) in [
        ("fall", &start, fall, 0.01),
        ("drag", &start, drag, 0.01),
        ("collapse", &ball, gravity, 2e-3),
        ("hill", &top, hill, 0.02),
    ] {
        let mut references = cpu(particles, forces, "leapfrog", dt);
        for _ in 0..20 {
            references.step(100).expect("steps");
            assert_eq!(runaway(block_on(references.check())), None, "{what}");
        }
    }
}

/// The scenes that come along, as far as a short test goes: those with few particles, or with fewer of them.
#[test]
fn scenes_do_not_run_away() {
    let scenes: [(&str, u32, &[&str]); 6] = [
        ("throw", 300, &[]),
        ("kepler", 1000, &[]),
        ("figure_eight", 1000, &[]),
        ("fountain", 500, &["particles.0.count=300"]),
        ("flock", 200, &["particles.0.count=300"]),
        ("galaxy", 200, &["particles.0.count=300"]),
    ];
    for (name, steps, changes) in scenes {
        let changes: Vec<String> = changes.iter().map(|&c| c.to_owned()).collect();
        let source = Source::find(name).expect("a scene that comes along");
        let mut scene = match Scene::load(&source, &changes, &Options::default()) {
            Ok(scene) => scene,
            Err(faults) => panic!("{name}: {faults}"),
        };
        let count = u32::try_from(scene.particles.len()).expect("few");
        let setup = scene.setup();
        let mut references = Simulation::on(Cpu::new(count).expect("some"), &setup).expect("a simulation");
        references.step(steps).expect("steps");
        assert_eq!(runaway(block_on(references.check())), None, "{name}");
    }
}
