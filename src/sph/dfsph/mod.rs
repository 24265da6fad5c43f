//! Divergence-free smoothed particle hydrodynamics (Bender & Koschier 2015): pressure is solved for, so that the time step is limited by
//! the flow, and not by the speed of sound.
//!
//! Both of its solves have the same form: find κ ≥ 0 such that accelerations a = −Σ V (κ + κ') ∇W compress by no more than s in the step,
//! dt² D(a) ≤ s. The first, the divergence solve, has s = −dt D(v), and removes the compressing part of the velocity; the second, the
//! density solve, has s = 1 − ρ/ρ₀ − dt D(v + dt a) with all accelerations, and keeps the density. Both are expressed in accelerations,
//! before the kick.

mod begin;
mod collect;
mod decide;
mod finish;
mod keep;
mod pairs;
mod push;
mod response;

use super::Medium;
use crate::error::Error;
use crate::kernel::{Host, Kernel, Name, Pass, Plan, Problem, Reference, Scalar, Shader, Source};
use crate::neighbors::{Grid, SORTED_ID, SORTED_POSITION, SORTED_VELOCITY, STARTS};
use crate::visit::{Candidate, Law, Search};

use pairs::Pairs;

pub use keep::{ERRORS as DFSPH_ERRORS, REPORT as DFSPH_REPORT, WORDS as DFSPH_WORDS, columns};

/// The tolerances and iteration limits of the pressure solves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Asked {
    /// The tolerated mean error of the density, relative to the density.
    pub density: f64,
    /// The tolerated mean compression by the velocity in a step, likewise.
    pub divergence: f64,
    /// The minimum number of iterations.
    pub least: u32,
    /// The maximum number of iterations.
    pub most: u32,
}

/// One of the two solves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Solve {
    Divergence,
    Density,
}

/// The warm start: the part of the κ of the last step with which a solve begins. Without it a column at rest takes a quarter more
/// iterations; with all of it the column does not come to rest.
const WARM: f64 = 0.5;

/// The κ of walls.
const WALL: f64 = -1.0;

/// The members of the shaders' structs, in their order.
const RESPONSE: usize = 4;
const UNKNOWN: usize = 4;
const STIFFNESS: usize = 2;
const STATE: usize = 3;

const RESPONSES: &str = "responses";
const UNKNOWNS: &str = "unknowns";
const PUSHES: &str = "pushes";
const ERRORS: &str = "errors";
const PAIRS: &str = "pairs";
const STATES: &str = "dfsph_state";
const KAPPA: &str = "stiffness";
const WARM_START: &str = "warm_start";

/// A fluid in a problem, for which pressure is solved.
pub struct Dfsph<'a> {
    medium: Medium,
    asked: Asked,
    problem: &'a Problem,
    grid: Grid,
    pairs: Option<Pairs>,
}

impl<'a> Dfsph<'a> {
    /// A fluid with these tolerances.
    ///
    /// # Errors
    /// [`Error::Scene`] when they are not possible.
    pub fn new(medium: Medium, asked: Asked, problem: &'a Problem) -> Result<Self, Error> {
        asked.check()?;
        let grid = medium.grid(problem)?;
        let pairs = Pairs::fitting(&medium, &grid, problem);
        Ok(Self { medium, asked, problem, grid, pairs })
    }
    /// Adds both solves to a plan in which all other accelerations have been added.
    ///
    /// # Errors
    /// When a shader does not compile.
    pub fn evaluate(&self, plan: &mut Plan) -> Result<(), Error> {
        let iterations = [self.iteration(Solve::Divergence)?, self.iteration(Solve::Density)?];
        let [divergence, density] = iterations;
        plan.add(response::kernel(self)?);
        plan.add(begin::kernel(self)?);
        self.iterate(plan, Solve::Divergence, divergence)?;
        plan.add(collect::collect(self)?);
        plan.add(collect::predict(self)?);
        self.iterate(plan, Solve::Density, density)?;
        plan.add(finish::kernel(self)?);
        Ok(())
    }
    /// Adds the kernels at the end of a step.
    ///
    /// # Errors
    /// When a shader does not compile.
    pub fn conclude(&self, plan: &mut Plan) -> Result<(), Error> {
        plan.add(keep::kernel(self)?);
        Ok(())
    }
    fn iteration(&self, solve: Solve) -> Result<Vec<Kernel>, Error> {
        let mut kernels = vec![push::push(self, solve)?, push::correct(self, solve)?];
        kernels.extend(decide::kernels(self, solve)?);
        Ok(kernels)
    }
    fn iterate(&self, plan: &mut Plan, solve: Solve, iteration: Vec<Kernel>) -> Result<(), Error> {
        plan.repeat(self.asked.most, STATES, solve as u32, "code", Plan::of(iteration))
    }
    /// ω of Jacobi's method. With Nesterov's it may be up to 4/3 over the largest eigenvalue of the matrix over its diagonal; that is
    /// found by the power method in jittered blocks to be 2.7 in two dimensions and 3.5 in three where the support is two
    /// spacings, 4.2 and 7.7 where it is three.
    fn relaxation(&self) -> f64 {
        let wide = self.medium.support / 2.0;
        1.25 / if self.medium.dimensions == 2 { 2.75 * wide } else { 3.5 * wide * wide }
    }
    /// Neighbours of a particle inside of the fluid; with fewer, compression by the velocity is left to the density.
    fn fewest(&self) -> f64 {
        if self.medium.dimensions == 2 { 7.0 } else { 20.0 }
    }
    /// The field of the cell list for a name of shaders.
    fn name(&self, field: &'static str) -> Name {
        self.grid.field(field).1
    }
    /// The ids in the order of the cell list: those of the fluid, which come first, if their number is known. Otherwise wall particles and
    /// empty slots are included; the state of a slot distinguishes them.
    fn slots(&self) -> impl Fn(&Host) -> Result<Vec<usize>, Error> + Send + Sync + use<> {
        let fluid = self.grid.of_those_ahead();
        move |host| {
            let (ids, starts) = (fluid.occupants(host)?, fluid.field(STARTS).1);
            let all = ids.len();
            let starts = if host.contains(&starts) { host.reading::<u32>(&starts)?.to_vec() } else { Vec::new() };
            let end = starts.get(fluid.count() as usize).map_or(all, |n| *n as usize);
            Ok(ids.iter().take(end).map(|id| *id as usize).collect())
        }
    }
    /// The files of a search, with files that use `state.wgsl`.
    fn files(&self, own: Vec<Source>) -> Vec<Source> {
        let mut all = vec![crate::shader!("sph/dfsph/state.wgsl"), self.medium.smoothing.source()];
        all.push(crate::shader!("sph/medium.wgsl"));
        all.extend(own);
        all
    }
    /// A search of the fluid's particles, with these fields in the order of the cell list.
    fn searching(&self, candidate: Candidate, fields: &[&'static str]) -> Search {
        let (grid, files, constants) = (Some(self.grid.clone()), self.files(Vec::new()), self.medium.constants());
        Search { grid, candidate, fields: fields.to_vec(), files, constants, fixed: false }
    }
    /// The kernel of a law that evaluates all pairs before these are known, with a `gather` of where they are.
    fn search(&self, law: Law) -> Result<Kernel, Error> {
        let kernel = match self.pairs {
            Some(pairs) => pairs.find(self, &law)?,
            None => law.kernel(self.problem)?,
        };
        Ok(self.bound(kernel))
    }
    /// The kernel of a law whose pairs are known: each `meet`s the other with its V g r.
    fn sweep(&self, mut law: Law) -> Result<Kernel, Error> {
        let kernel = if let Some(pairs) = self.pairs {
            pairs.sweep(self, &law)?
        } else {
            let walked = crate::shader!("sph/dfsph/walked.wgsl");
            law.search.iter_mut().for_each(|search| search.files.push(walked.clone()));
            law.kernel(self.problem)?
        };
        Ok(self.bound(kernel))
    }
    /// A kernel over slots or particles, or with a given number of invocations.
    fn plain(
        &self,
        name: &str,
        files: &[Source],
        extent: &[(&'static str, Scalar)],
        threads: u32,
        reference: Reference,
    ) -> Result<Kernel, Error> {
        let mut all = vec![crate::shader!("world.wgsl"), crate::shader!("fields.wgsl")];
        all.push(crate::shader!("neighbors/starts.wgsl"));
        all.extend(self.files(files.to_vec()));
        let shader = Shader::join(&all)?;
        let uniforms = shader.block(name, "extent", extent)?;
        let mut constants = self.grid.of_those_ahead().constants(&shader);
        constants.extend(shader.reflection().known(&self.medium.constants()));
        let pass = Pass { constants, uniforms, ..Pass::new(shader.clone(), threads) };
        let kernel = Kernel { passes: vec![pass], ..Kernel::new(name, shader, Vec::new(), threads, reference) };
        Ok(self.bound(kernel))
    }
    /// The same with the fields of the cell list, and the sizes of what does not have one element for each particle.
    fn bound(&self, mut kernel: Kernel) -> Kernel {
        let sorted = [STARTS, SORTED_ID, SORTED_POSITION, SORTED_VELOCITY];
        let own = [UNKNOWNS, PUSHES, ERRORS];
        let fields: Vec<_> = sorted.iter().chain(&own).map(|name| self.grid.field(name)).collect();
        for pass in &mut kernel.passes {
            let bound = |name: &str| pass.fields.iter().any(|(inside, _)| inside == name);
            let new: Vec<_> = fields
                .iter()
                .filter(|(name, _)| !bound(name))
                .map(|(name, field)| ((*name).into(), field.clone()))
                .collect();
            pass.fields.extend(new);
        }
        let (starts, bins) = (self.name(STARTS), u64::from(self.grid.bins()));
        if kernel.size(&starts).is_none() {
            kernel.sizes.push((starts, bins));
        }
        kernel.sizes.extend([(STATES.into(), 2), (keep::REPORT.into(), keep::WORDS as u64), (keep::ERRORS.into(), 2)]);
        kernel
    }
}

impl Solve {
    fn name(self) -> &'static str {
        match self {
            Self::Divergence => "divergence",
            Self::Density => "density",
        }
    }
}

/// The same with values for those `override`s that its shaders have.
fn with(mut kernel: Kernel, constants: &[(&'static str, f64)]) -> Kernel {
    for pass in &mut kernel.passes {
        pass.constants.extend(pass.shader.reflection().known(constants));
    }
    kernel
}

impl Asked {
    /// Checks whether the tolerances are possible.
    ///
    /// # Errors
    /// [`Error::Scene`] when they are not.
    pub fn check(&self) -> Result<(), Error> {
        /// Sums of thirty terms near 1, in single precision.
        const FINEST: f64 = 2e-6;
        let finest = self.density.min(self.divergence);
        if finest < FINEST {
            return Err(Error::Scene(format!(
                "the density tolerance of a fluid is {finest:e}: single precision resolves {FINEST:e}, and 1e-4 is usual"
            )));
        }
        if self.most < self.least || self.most > 1000 {
            return Err(Error::Scene(format!(
                "a fluid's pressure solve has {} to {} iterations: max_iterations must be at least min_iterations, and 1000 at most",
                self.least, self.most
            )));
        }
        Ok(())
    }
}
