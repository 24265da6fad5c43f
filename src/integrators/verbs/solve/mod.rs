//! The linear solve of implicit integrators: rows of the system, preconditioned conjugate gradients by Chronopoulos & Gear (1989) in two
//! dispatches for each iteration, and the update by the solution. Nothing is read back in between.

pub mod begin;
pub mod iterate;
pub mod report;
pub mod rows;
pub mod update;

use std::sync::Arc;

use glam::Vec4;

use crate::error::Error;
use crate::forces::Law;
use crate::kernel::{Field, Kernel, Pass, Problem, Reference, Scalar, Shader, Source};
use crate::visit::Tables;

/// The positions at the start of a solve.
pub const START_POSITION: Field<Vec4> = Field::new("start_position");
/// The velocities at the start of a solve.
pub const START_VELOCITY: Field<Vec4> = Field::new("start_velocity");
/// The accelerations of explicit laws there, saved during the solve.
pub const EXPLICIT: Field<Vec4> = Field::new("explicit_acceleration");
const RESIDUALS: Field<Vec4> = Field::new("residuals");
const DIRECTIONS: Field<Vec4> = Field::new("directions");
const DOTS: Field<f32> = Field::new("dots");
/// The state of the solve when it has ended. During the solve, state and next state are swapped.
pub const STATE: &str = "solve_state";
const OTHER: &str = "solve_other";

/// The values of a row's kind, as in the shader.
const HELD: f64 = 0.0;
const TIED: f64 = 1.0;
const ALONE: f64 = 2.0;

/// The members of `State`, in the order of the shader's.
#[derive(Debug, Clone, Copy, Default)]
struct State {
    first: f64,
    gamma: f64,
    alpha: f64,
    residual: f64,
    iterations: f64,
    total: f64,
    code: f64,
    settled: f64,
    broken: f64,
}

impl State {
    fn of(words: &[f64]) -> Self {
        let at = |place: usize| words.get(place).copied().unwrap_or(0.0);
        Self {
            first: at(0),
            gamma: at(1),
            alpha: at(2),
            residual: at(3),
            iterations: at(4),
            total: at(5),
            code: at(6),
            settled: at(7),
            broken: at(8),
        }
    }
    fn words(self) -> [f64; 9] {
        let Self { first, gamma, alpha, residual, iterations, total, code, settled, broken } = self;
        [first, gamma, alpha, residual, iterations, total, code, settled, broken]
    }
}

/// The part of the step that is solved for, and its method.
#[derive(Clone)]
pub struct System<'a> {
    pub problem: &'a Problem,
    /// The length of the part, relative to the step.
    pub factor: f64,
    /// The law of links that enters the matrix, if there is one.
    pub links: Option<Law>,
}

/// The maximum number of loop iterations of one invocation in one dispatch: every driver allows 65 535.
const TRIPS: u32 = 60_000;
/// Invocations in a workgroup of the two halves of an iteration.
const WORKGROUP: u32 = 256;
/// Workgroups on a software adapter: a few for each of its cores, since each costs barriers.
const SOFTWARE: u32 = 16;

impl System<'_> {
    /// The number of particles of a workgroup in an iteration, and the number of workgroups.
    pub fn cut(&self) -> (u32, u32) {
        let (count, machine) = (self.problem.capacity, &self.problem.machine);
        let starts = &self.problem.network.link_start;
        let degree = starts.windows(2).map(|w| w[1] - w[0]).max().filter(|_| self.links.is_some()).unwrap_or(0);
        let most = if machine.software { SOFTWARE } else { (machine.invocations / WORKGROUP).max(1) };
        let groups = count.div_ceil(WORKGROUP).clamp(1, most);
        // Particles of one invocation, limited by its number of loop iterations.
        let each = count.div_ceil(groups).div_ceil(WORKGROUP).clamp(1, (TRIPS / (degree + 1)).max(1));
        (each * WORKGROUP, count.div_ceil(each * WORKGROUP).max(1))
    }
    /// A kernel of one dispatch, of files that call the Jacobian of the links.
    fn tied(&self, name: &str, files: &[Source], reference: Reference) -> Result<Kernel, Error> {
        let mut all = vec![crate::shader!("integrators/solve_row.wgsl")];
        let (shader, uniforms) = if let Some(law) = &self.links {
            all.extend([Tables::of(self.problem).file(), crate::shader!("integrators/solve_links.wgsl")]);
            all.extend_from_slice(files);
            law.beside(&all, self.problem)?
        } else {
            all.splice(
                0..0,
                [crate::shader!("world.wgsl"), crate::shader!("fields.wgsl"), crate::shader!("particle.wgsl")],
            );
            all.push(crate::shader!("integrators/solve_alone.wgsl"));
            all.extend_from_slice(files);
            (Shader::join(&all)?, Vec::new())
        };
        let mut kernel = Kernel::new(name, shader.clone(), Vec::new(), self.problem.capacity, reference);
        kernel.passes[0].constants = self.problem.constants(&shader);
        kernel.passes[0].uniforms = uniforms;
        let kernel = self.sized(kernel);
        Ok(if self.links.is_some() {
            crate::visit::bind(kernel, crate::forces::Over::Links, self.problem)
        } else {
            kernel
        })
    }
    /// The same with the sizes of fields that do not have one element for each particle.
    fn sized(&self, mut kernel: Kernel) -> Kernel {
        let (_, groups) = self.cut();
        kernel.sizes.extend([(STATE.into(), 1), (OTHER.into(), 1), (DOTS.name.into(), u64::from(groups))]);
        kernel
    }
    /// Divides a kernel of one dispatch into the workgroups of an iteration.
    fn in_runs(&self, mut kernel: Kernel) -> Result<Kernel, Error> {
        let (chunk, groups) = self.cut();
        for pass in &mut kernel.passes {
            let values = [("chunk", Scalar::Uint(chunk)), ("groups", Scalar::Uint(groups))];
            let block = pass.shader.reflection().binding("extent").map(|b| b.packed.pack("extent", &values));
            pass.uniforms.extend(block.transpose()?.map(|bytes| ("extent", bytes)));
            pass.threads.count = groups * WORKGROUP;
        }
        Ok(kernel)
    }
}

/// A kernel of one dispatch over all particles, of files that access rows.
fn plain(name: &str, system: &System<'_>, source: Source, reference: Reference) -> Result<Kernel, Error> {
    let shader = Shader::join(&[crate::shader!("world.wgsl"), crate::shader!("integrators/solve_row.wgsl"), source])?;
    Ok(system.sized(Kernel::new(name, shader, Vec::new(), system.problem.capacity, reference)))
}

/// The same, named after its constants, so that kernels with different constants differ.
fn with(mut kernel: Kernel, constants: &[(&'static str, f64)]) -> Kernel {
    for pass in &mut kernel.passes {
        let known = pass.shader.reflection();
        pass.constants.extend(known.known(constants));
    }
    kernel
}

/// The same on the two states, in their order; `turned`: swapped.
fn on_states(mut kernel: Kernel, turned: bool) -> Kernel {
    let (from, to) = if turned { (OTHER, STATE) } else { (STATE, OTHER) };
    let passes = std::mem::take(&mut kernel.passes);
    kernel.passes =
        passes.into_iter().map(|p: Pass| p.on(&[("solve_state", from.into()), ("solve_next", to.into())])).collect();
    kernel
}

/// The names of the two states, in that order.
fn names(turned: bool) -> (&'static str, &'static str) {
    if turned { (OTHER, STATE) } else { (STATE, OTHER) }
}

/// Shares a reference.
fn reference(reference: impl Fn(&crate::kernel::Host) -> Result<(), Error> + Send + Sync + 'static) -> Reference {
    Arc::new(reference)
}
