//! Steps as long as forces allow, and the ledger of a fluid.

mod clock;
mod ledger;
mod limits;
mod motions;
mod scenes;

use std::sync::Arc;

use crate::support::Shared;
use crate::support::states::{force, integrator};
use glam::DVec3;
use motes::error::Error;
use motes::forces::{Component, Law, Problem, Properties, Resolved, Stage};
use motes::integrators::Adaptive;
use motes::kernel::{AdaptiveStep, Backend, Plan};
use motes::settings::Value;
use motes::simulation::Clock;
use motes::sph::{self, Limits, Medium, Smoothing};
use motes::{Bounds, Cpu, Gpu, Setup, Simulation, Solver, State};

/// The longest step.
const DT: f64 = 0.013;
const SPACING: f64 = 0.1;
/// Half of the support.
const LENGTH: f64 = 0.1;

/// A force that does nothing and limits nothing: steps end where the run stops.
#[derive(Clone)]
struct Free;

impl Component for Free {
    fn properties(&self) -> Properties {
        Properties { limits_steps: true, ..Properties::default() }
    }
    fn laws(&self) -> Vec<Law> {
        Vec::new()
    }
    fn resolved(&self, _: &Problem) -> Result<Resolved, Error> {
        Ok(Resolved { viscous_steps: Some(0.0), ..Resolved::default() })
    }
}

/// The limits of a fluid without sound, and nothing else of it.
#[derive(Clone)]
struct Silent;

impl Silent {
    fn medium(problem: &Problem) -> Medium {
        let dimensions = problem.bounds.dimensions;
        let (density, spacing, support) = (1000.0, SPACING, 2.0);
        let smoothing = Smoothing::Cubic;
        Medium { density, spacing, support, smoothing, sound: 0.0, exponent: 7, negative: false, dimensions }
    }
}

impl Component for Silent {
    fn laws(&self) -> Vec<Law> {
        Vec::new()
    }
    fn resolved(&self, problem: &Problem) -> Result<Resolved, Error> {
        let medium = Self::medium(problem);
        let none = sph::Friction { alpha: 0.0, viscosity: 0.0, form: sph::Form::Central, wall: 1.0 };
        let viscous_steps = sph::viscous_steps(&medium, none, problem);
        Ok(Resolved { cell_lists: vec![(medium.grid(problem)?, true)], viscous_steps, ..Resolved::default() })
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        if stage != Stage::StepLimit {
            return Ok(());
        }
        let medium = Self::medium(problem);
        let (of, over) = (move |_: &Bounds| Ok(medium), motes::Over::Each);
        sph::limits(&(Arc::new(of) as sph::Boxed), over, Limits { sound: None, alpha: 0.0 }, plan, problem)
    }
}

/// Steps down to a thousandth, with C = 0.3.
const ADAPTIVE: AdaptiveStep = AdaptiveStep { least: DT / 1000.0, courant: 0.3, before: None };

fn adapted(particles: &State, forces: Vec<Box<dyn Component>>, name: &str, adaptive_step: AdaptiveStep) -> Setup {
    Setup {
        state: particles.clone(),
        forces,
        integrator: Box::new(Adaptive { integrator: integrator(name), adaptive_step }),
        dt: DT,
        bounds: Bounds::default(),
        solver: Solver::default(),
    }
}

fn on_gpu(shared: &Shared, setup: &Setup) -> Simulation<Gpu> {
    Simulation::new(&shared.found.device, &shared.found.queue, setup).expect("a simulation")
}

fn on_cpu(setup: &Setup) -> Simulation<Cpu> {
    let count = u32::try_from(setup.state.len()).expect("few");
    Simulation::on(Cpu::new(count).expect("a processor"), setup).expect("a simulation")
}

fn clock<B: Backend>(simulation: &mut Simulation<B>) -> Clock {
    pollster::block_on(simulation.clock()).expect("a clock").expect("adaptive steps")
}

/// `fluid` with a speed of sound, and some more.
fn fluid(sound: f64, more: &[(&'static str, Value)]) -> Box<dyn Component> {
    let mut settings = vec![("spacing", Value::Number(SPACING)), ("sound_speed", Value::Number(sound))];
    settings.extend_from_slice(more);
    force("fluid", &settings)
}

/// A drop of 5 × 5 × 5 particles that flies apart and together, somewhat out of its lattice.
fn drop() -> State {
    let mut random = crate::support::Random::new(17);
    let mut particles = State::default();
    for i in 0..125u32 {
        let place = DVec3::new(f64::from(i % 5), f64::from(i / 5 % 5), f64::from(i / 25));
        let x = (SPACING * (place + 0.1 * random.vector())).as_vec3().as_dvec3();
        particles.push(x, (0.3 * random.vector()).as_vec3().as_dvec3(), f64::from(1.0f32), 0.02);
    }
    particles
}
