//! Births under steps that are not all alike.

use glam::DVec3;
use motes::integrators::Adaptive;
use motes::kernel::AdaptiveStep;
use motes::life::Life;
use motes::settings::Value;
use motes::{Bounds, Setup, Simulation, State};

use crate::births::{DT, emitted, fluid_with, setup, state};
use crate::support::states::word;
use crate::support::{self, machines};

const SOUND: f64 = 8.0;
const COURANT: f64 = 0.25;
/// A step of a fluid at rest: C s / c, with s half of the support of two spacings.
const LONGEST: f64 = COURANT * 0.1 / SOUND;

/// Of each, which single precision holds: ρ₀ d².
const MASS: f64 = 10.0;

/// A jet in the plane, four abreast; its first row is spawned while steps are as long as they may be.
fn jet(start: f64) -> State {
    let settings = [
        ("shape", word("rectangle")),
        ("size", Value::Vector(DVec3::new(0.4, 0.4, 0.0))),
        ("direction", Value::Vector(DVec3::X)),
        ("speed", Value::Number(1.3)),
        ("spacing", Value::Number(0.1)),
        ("start", Value::Number(start)),
    ];
    emitted(&settings, 2, 0.5)
}

fn adapted(particles: State, more: &[(&'static str, Value)]) -> Setup {
    let forces = vec![fluid_with(&[&[("sound_speed", Value::Number(SOUND))], more].concat())];
    let even = setup(particles, forces, Bounds { dimensions: 2, ..Bounds::default() });
    let adaptive_step = AdaptiveStep { least: DT / 1000.0, courant: COURANT, before: None };
    Setup { integrator: Box::new(Adaptive { integrator: even.integrator, adaptive_step }), ..even }
}

/// Each is spawned at the end of the step that reaches its time, where it has flown to since, and weighs what it should; and as
/// soon as one is active, steps are those of a fluid.
#[test]
fn births_keep_their_times() {
    let particles = jet(0.03);
    let shared = support::device();
    let setup = adapted(particles.clone(), &[]);
    let mut simulation = Simulation::on(machines::gpu(&shared, particles.len()), &setup).expect("a run");
    let (mut lived, mut lengths) = (0, Vec::new());
    for _ in 0..40 {
        simulation.step(1).expect("a step");
        let clock = pollster::block_on(simulation.clock()).expect("a clock").expect("adaptive steps");
        lengths.push(clock.dt);
        assert!(lived == 0 || clock.dt <= LONGEST * (1.0 + 1e-6), "{} after {lived} were born", clock.dt);
        let now = state(&mut simulation);
        let (time, soon) = (clock.time, clock.dt / 32.0);
        lived = now.population().active;
        for birth in &particles.births {
            let (id, is_active) = (birth.id as usize, now.life()[birth.id as usize] == Life::Active);
            assert!(is_active || birth.time > time, "{id} is late: {} at {time}", birth.time);
            assert!(!is_active || birth.time < time + soon, "{id} is early: {} at {time}", birth.time);
            let mass = if is_active { MASS } else { 0.0 };
            assert!(now.mass()[id].to_bits() == mass.to_bits(), "{id} weighs {}", now.mass()[id]);
            // Three rows go straight on.
            let way = if is_active { birth.velocity * (time - birth.time) } else { DVec3::ZERO };
            let off = (now.position()[id] - particles.position()[id] - way).length();
            assert!(off < 1e-5 || time > birth.time + 0.3 / 1.3, "{id} is {off} from its way");
        }
        let ledger = now.mass().iter().sum::<f64>();
        assert!(ledger.to_bits() == (lived as f64 * MASS).to_bits(), "{ledger}");
    }
    // The first steps have no active particle, and then there are those of a fluid.
    assert!((lengths[0] - DT).abs() < 1e-6 && lived >= 8, "{lived}: {lengths:?}");
}
