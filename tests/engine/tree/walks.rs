//! Walks to look at: a law over a tree of some bodies, on a machine that brings about a variant.

use glam::{DVec3, DVec4, Vec4};
use motes::forces::{Component, Law, Over};
use motes::integrators::Step;
use motes::kernel::{ACCELERATION, Backend, Machine, Pass, Plan, Problem};
use motes::lockstep::{Verdict, compare};
use motes::settings::Value;
use motes::tree::Opening;
use motes::{Bounds, Gpu, Setup, Simulation, Solver, State};

use crate::support::Shared;
use crate::support::machines;
use crate::support::states::{force, integrator, word};

/// Held by f32.
pub const SOFTENING: f64 = 0.046_875;

/// What a scene may say of gravity over a tree.
#[derive(Debug, Clone, Copy)]
pub struct Settings {
    pub theta: f64,
    pub alpha: f64,
    pub kernel: &'static str,
    pub multipoles: &'static str,
    pub softening: f64,
}

pub const USUAL: Settings =
    Settings { theta: 0.5, alpha: 0.0, kernel: "plummer", multipoles: "quadrupole", softening: SOFTENING };

/// Gravity over a tree, or over what a word says.
pub fn gravity(over: &'static str, settings: Settings) -> Box<dyn Component> {
    let number = Value::Number;
    let Settings { theta, alpha, kernel, multipoles, softening } = settings;
    force(
        "gravity",
        &[
            ("over", word(over)),
            ("theta", number(theta)),
            ("alpha", number(alpha)),
            ("kernel", word(kernel)),
            ("multipoles", word(multipoles)),
            ("softening", number(softening)),
        ],
    )
}

/// One law as a force.
#[derive(Clone)]
pub struct Alone(pub Law);

impl Component for Alone {
    fn laws(&self) -> Vec<Law> {
        vec![self.0.clone()]
    }
}

pub fn over(theta: f64) -> Over {
    Over::Tree { opening: Opening::Geometric { theta }, core: 0.0, auto: false }
}

/// Bodies at rest.
pub fn particles(bodies: &[Vec4]) -> State {
    let mut all = State::default();
    bodies.iter().map(|b| b.as_dvec4()).for_each(|b| all.push(b.truncate(), DVec3::ZERO, b.w, 0.01));
    all
}

/// Whether a pass walks a tree.
pub fn walks(pass: &Pass) -> bool {
    pass.shader.sources().iter().any(|source| source.file.ends_with("tree_nodes.wgsl"))
}

/// A device, bodies, and the plan of a force at them.
pub struct Walk {
    pub simulation: Simulation<Gpu>,
    pub plan: Plan,
    count: u32,
}

impl Walk {
    pub fn new(shared: &Shared, machine: Machine, bodies: &[Vec4], force: Box<dyn Component>) -> Self {
        Self::on(machines::gpu(shared, bodies.len()), machine, bodies, force)
    }
    pub fn on(gpu: Gpu, machine: Machine, bodies: &[Vec4], force: Box<dyn Component>) -> Self {
        Self::within(gpu, machine, bodies, Bounds::default(), force)
    }
    /// The same in a box.
    pub fn within(mut gpu: Gpu, machine: Machine, bodies: &[Vec4], bounds: Bounds, force: Box<dyn Component>) -> Self {
        gpu.pretend(machine);
        let count = u32::try_from(bodies.len()).expect("few");
        let forces = [force];
        let particles = particles(bodies);
        let mut step = Step::new(&forces, Problem::new(count, machine).at(particles.position(), bounds));
        step.evaluate();
        let plan = step.finished().expect("a plan");
        let setup = Setup {
            state: particles,
            forces: Vec::new(),
            integrator: integrator("symplectic_euler"),
            dt: 0.37,
            bounds,
            solver: Solver::default(),
        };
        let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
        simulation.backend().compile(&plan).expect("a program");
        Self { simulation, plan, count }
    }
    /// The same after an evaluation with these accelerations, which a relative opening needs.
    pub fn after(mut self, last: &[Vec4]) -> Self {
        self.simulation.write(ACCELERATION, last).expect("their last accelerations");
        self
    }
    /// The passes that walk.
    pub fn passes(&mut self) -> &mut Vec<Pass> {
        let mut kernels = self.plan.kernels.iter_mut().map(|kernel| &mut kernel.passes);
        kernels.find(|passes| passes.first().is_some_and(walks)).expect("a walk")
    }
    /// Whether the plan has a file.
    pub fn has(&self, file: &str) -> bool {
        let mut passes = self.plan.kernels.iter().flat_map(|kernel| &kernel.passes);
        passes.any(|pass| pass.shader.sources().iter().any(|source| source.file.ends_with(file)))
    }
    /// How many times a walk continues, at most, summed over its dispatches.
    pub fn rounds(&mut self) -> usize {
        self.passes().iter().filter(|pass| pass.indirect.is_some()).count()
    }
    /// Particles in it.
    pub fn count(&self) -> usize {
        self.count as usize
    }
    /// The walk in dispatches of so many targets, which are whole groups.
    pub fn cut(mut self, targets: u32) -> Self {
        let count = self.count;
        let passes = self.passes();
        *passes = machines::parts(&passes[0], count, targets);
        self
    }
    /// The accelerations of all bodies.
    pub fn run(&mut self) -> Vec<Vec4> {
        let program = self.simulation.backend().compile(&self.plan).expect("a program");
        self.simulation.backend().run(&program, 1).expect("a run");
        pollster::block_on(self.simulation.read(ACCELERATION)).expect("accelerations")
    }
    /// The verdict of the walk against its reference.
    pub fn verdict(&mut self) -> Verdict {
        let all = pollster::block_on(compare(self.simulation.backend(), &self.plan, self.count)).expect("a comparison");
        let name = self.plan.kernels.iter().find(|kernel| walks(&kernel.passes[0])).map(|kernel| kernel.name.clone());
        let walk = |verdict: &Verdict| Some(&verdict.kernel) == name.as_ref() && verdict.field == ACCELERATION.name;
        all.into_iter().find(walk).expect("a walk")
    }
}

/// Accelerations of some targets by direct summation of Plummer's law, and the sum of the sizes of all pulls on each, in f64.
pub fn direct(bodies: &[Vec4], softening: f64, targets: impl Iterator<Item = usize>) -> Vec<(usize, DVec4, f64)> {
    let all: Vec<DVec4> = bodies.iter().map(|b| b.as_dvec4()).collect();
    let acceleration = |i: usize| {
        let mut pulls = 0.0;
        let mut sum = DVec4::ZERO;
        for (_, you) in all.iter().enumerate().filter(|(j, _)| *j != i) {
            let r = (*you - all[i]).truncate();
            let inverse = 1.0 / (r.length_squared() + softening * softening).sqrt();
            let pull = r * (you.w * inverse.powi(3));
            pulls += pull.length();
            sum += pull.extend(-0.5 * you.w * inverse);
        }
        (i, sum, pulls)
    };
    targets.map(acceleration).collect()
}
