//! The pairs in range, stored for all laws of a step, if there is room for them: one search serves some twenty of them.

use super::{Dfsph, PAIRS};
use crate::error::Error;
use crate::kernel::{Kernel, Pass, Problem, Shader, Source, Table};
use crate::neighbors::Grid;
use crate::sph::Medium;
use crate::visit::{Candidate, Law, Search};

/// The capacity for neighbours, relative to those of a fluid at rest: a particle with more is reported, and ends the run.
const ROOM: u32 = 2;
/// Rows, in whole lots of these.
const LOT: u32 = 8;
/// Bytes of a pair.
const PAIR: u64 = 16;
/// Slots that single precision distinguishes.
const SLOTS: u32 = 1 << 24;

/// Rows of pairs: how many neighbours each slot has, and the n-th of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Pairs {
    rows: u32,
    stride: u32,
}

impl Pairs {
    /// The pairs, if they fit a binding.
    pub fn fitting(medium: &Medium, grid: &Grid, problem: &Problem) -> Option<Self> {
        let ball =
            if medium.dimensions == 2 { 1.0 } else { 4.0 / 3.0 * medium.support } * medium.support * medium.support;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 6 spacings: below 2000")]
        let rows = (std::f64::consts::PI * ball).ceil() as u32 * ROOM;
        let pairs = Self { rows: rows.next_multiple_of(LOT), stride: grid.ahead(problem).max(1) };
        let fits = PAIR * pairs.elements() <= problem.machine.bindable && problem.capacity <= SLOTS;
        fits.then_some(pairs)
    }
    fn elements(self) -> u64 {
        u64::from(1 + self.rows) * u64::from(self.stride)
    }
    fn constants(self) -> [(&'static str, f64); 2] {
        [("STRIDE", f64::from(self.stride)), ("ROOM", f64::from(self.rows))]
    }
    /// The kernel that finds them, and in which a law evaluates each once.
    pub fn find(self, of: &Dfsph<'_>, law: &Law) -> Result<Kernel, Error> {
        let slots = Candidate {
            particle: crate::shader!("sph/dfsph/slots.wgsl"),
            broadcast: crate::shader!("sph/dfsph/slots_broadcast.wgsl"),
            listed: None,
        };
        let search = Search { files: Vec::new(), constants: Vec::new(), ..of.searching(slots, &[]) };
        let wgsl = crate::shader!("sph/dfsph/neighbors.wgsl");
        let lists = Law { wgsl, into: Vec::new(), search: Some(search), ..law.clone() };
        let mut kernel = lists.kernel(of.problem)?;
        let (pass, tables) = self.pass(of, law, crate::shader!("sph/dfsph/listed.wgsl"))?;
        kernel.passes.push(pass);
        kernel.tables = tables;
        kernel.scratch.push(of.name(PAIRS));
        Ok(self.bound(of, kernel))
    }
    /// The kernel of a law that evaluates the stored pairs of a particle.
    pub fn sweep(self, of: &Dfsph<'_>, law: &Law) -> Result<Kernel, Error> {
        let (pass, tables) = self.pass(of, law, crate::shader!("sph/dfsph/paired.wgsl"))?;
        let (name, passes, reference) = (law.name.clone(), vec![pass], law.reference.clone());
        Ok(self.bound(of, Kernel { name, passes, reference, sizes: Vec::new(), scratch: Vec::new(), tables }))
    }
    /// A law joined with what visits pairs.
    fn pass(self, of: &Dfsph<'_>, law: &Law, visit: Source) -> Result<(Pass, Vec<Table>), Error> {
        let mut all = vec![
            crate::shader!("world.wgsl"),
            crate::shader!("fields.wgsl"),
            crate::shader!("neighbors/cell.wgsl"),
            crate::shader!("neighbors/starts.wgsl"),
            visit,
            law.wgsl.clone(),
        ];
        if let Some(search) = &law.search {
            all.push(search.candidate.particle.clone());
            all.extend_from_slice(&search.files);
        }
        let tables = of.problem.hold(&mut all);
        let shader = Shader::join(&all)?;
        let mut constants = of.problem.constants(&shader);
        constants.extend(of.grid.of_those_ahead().constants(&shader));
        constants.extend(law.search.iter().flat_map(|search| shader.reflection().known(&search.constants)));
        let work = self.elements() / u64::from(ROOM);
        Ok((Pass { constants, work, ..Pass::new(shader, self.stride) }, tables))
    }
    fn bound(self, of: &Dfsph<'_>, kernel: Kernel) -> Kernel {
        let mut kernel = super::with(kernel, &self.constants());
        let (inside, pairs) = of.grid.field(PAIRS);
        kernel.passes.iter_mut().for_each(|pass| pass.fields.push((inside.into(), pairs.clone())));
        kernel.sizes.push((pairs, self.elements()));
        kernel
    }
}
