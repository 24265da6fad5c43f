//! Who is in range of whom, kept for all sweeps of a step, where there is room for it: one search serves some twenty of them.

use super::{Dfsph, PAIRS};
use crate::error::Error;
use crate::fluids::Medium;
use crate::kernel::{Kernel, Pass, Problem, Shader, Source, Twin};
use crate::neighbors::Grid;
use crate::visit::{Candidate, Sweep};

/// How many more neighbours there is room for than a fluid at rest has: somebody with more is told, and ends the run.
const ROOM: u32 = 2;
/// Rows, in whole lots of these.
const LOT: u32 = 8;
/// Bytes of a pair.
const PAIR: u64 = 16;
/// Slots that single precision tells apart.
const SLOTS: u32 = 1 << 24;

/// Rows of pairs: how many neighbours each slot has, and the n-th of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pairs {
    rows: u32,
    stride: u32,
}

impl Pairs {
    /// Where a binding holds them.
    pub fn fitting(medium: &Medium, grid: &Grid, problem: &Problem) -> Option<Self> {
        let ball =
            if medium.dimensions == 2 { 1.0 } else { 4.0 / 3.0 * medium.support } * medium.support * medium.support;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 6 spacings: below 2000")]
        let rows = (std::f64::consts::PI * ball).ceil() as u32 * ROOM;
        let pairs = Self { rows: rows.next_multiple_of(LOT), stride: grid.ahead(problem).max(1) };
        let fits = PAIR * pairs.elements() <= problem.machine.bindable && problem.count <= SLOTS;
        fits.then_some(pairs)
    }
    fn elements(self) -> u64 {
        u64::from(1 + self.rows) * u64::from(self.stride)
    }
    fn constants(self) -> [(&'static str, f64); 2] {
        [("STRIDE", f64::from(self.stride)), ("ROOM", f64::from(self.rows))]
    }
    /// The kernel that finds them, and meets everybody once.
    pub fn find(
        self,
        of: &Dfsph<'_>,
        name: &str,
        candidate: Candidate,
        files: Vec<Source>,
        twin: Twin,
    ) -> Result<Kernel, Error> {
        let slots = Candidate {
            particle: crate::shader!("fluids/dfsph/neighbors.wgsl"),
            broadcast: crate::shader!("fluids/dfsph/neighbors_broadcast.wgsl"),
        };
        let (params, constants, own) = (Vec::new(), Vec::new(), Vec::new());
        let (name, grid) = (name.to_owned(), of.grid.clone());
        let search = Sweep { name, grid, candidate: slots, files: own, params, constants, twin };
        let mut kernel = search.kernel(of.problem)?;
        let mut all = files;
        all.extend([candidate.particle, crate::shader!("fluids/dfsph/listed.wgsl")]);
        kernel.passes.push(self.pass(of, &all)?);
        kernel.scratch.push(of.name(PAIRS));
        Ok(self.bound(of, kernel))
    }
    /// A kernel of everybody who meets whom it is paired with.
    pub fn sweep(self, of: &Dfsph<'_>, name: String, files: Vec<Source>, twin: Twin) -> Result<Kernel, Error> {
        let mut all = files;
        all.push(crate::shader!("fluids/dfsph/paired.wgsl"));
        let passes = vec![self.pass(of, &all)?];
        let (sizes, scratch, tables) = (Vec::new(), Vec::new(), Vec::new());
        Ok(self.bound(of, Kernel { name, passes, twin: Some(twin), sizes, scratch, tables }))
    }
    fn pass(self, of: &Dfsph<'_>, files: &[Source]) -> Result<Pass, Error> {
        let mut all =
            vec![crate::shader!("world.wgsl"), crate::shader!("fields.wgsl"), crate::shader!("neighbors/cell.wgsl")];
        all.push(crate::shader!("neighbors/starts.wgsl"));
        all.extend_from_slice(files);
        let shader = Shader::join(&all)?;
        let mut constants = of.problem.constants(&shader);
        constants.extend(of.grid.of_those_ahead().constants(&shader));
        constants.extend(shader.reflection().known(&of.medium.constants()));
        let pass = Pass { constants, ..Pass::new(shader, self.stride) };
        let work = self.elements() / u64::from(ROOM);
        Ok(Pass { work, ..pass })
    }
    fn bound(self, of: &Dfsph<'_>, kernel: Kernel) -> Kernel {
        let mut kernel = super::with(kernel, &self.constants());
        let (inside, pairs) = of.grid.field(PAIRS);
        kernel.passes.iter_mut().for_each(|pass| pass.fields.push((inside, pairs.clone())));
        kernel.sizes.push((pairs, self.elements()));
        kernel
    }
}
