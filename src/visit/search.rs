//! The search of a law that belongs to a method with its own fields, some of them in the order of the cell list.

use glam::DVec3;

use super::{Candidate, Law, Outcome, Over, Particle, reference};
use crate::error::Error;
use crate::kernel::{Array, Host, Kernel, Name, Problem, Scalar, Source, World};
use crate::neighbors::{Grid, SORTED_ID};

/// The search of a law over `near`, in addition to its range.
#[derive(Clone)]
pub struct Search {
    /// The grid, which holds all particles.
    pub grid: Grid,
    /// The data of a neighbour that it loads.
    pub candidate: Candidate,
    /// Fields in the order of the cell list, by their names in WGSL. A law's reference reads and writes them by particle.
    pub sorted: Vec<&'static str>,
    /// Files beside the law's own.
    pub files: Vec<Source>,
    /// Values for `override`s, some of which its files may not have.
    pub constants: Vec<(&'static str, f64)>,
    /// Whether fixed particles, which the grid keeps after all others, are targets too.
    pub fixed: bool,
}

impl Law {
    /// A law of a method that searches a grid of its own; otherwise like [`Law::computing`]. It may write fields of the method that are not
    /// columns.
    pub fn searching<S: Default>(
        name: &str,
        search: Search,
        wgsl: Source,
        params: Vec<(&'static str, Scalar)>,
        into: &[&'static str],
        gather: impl Fn(&Particle, &Particle, DVec3, &World, &mut S) + Send + Sync + 'static,
        finish: impl Fn(&Particle, &S, &World, &mut Outcome) + Send + Sync + 'static,
    ) -> Self {
        let over = Over::Near { range: search.grid.range, of: None };
        let params = params.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
        let into = into.iter().map(|name| Name::from(*name)).collect();
        let reference = reference::searching(over, search.clone(), gather, finish);
        Self { into, search: Some(search), ..Self::plain(name, over, wgsl, params, reference) }
    }
    /// Whether its WGSL, or a file beside it, contains these words in a row.
    pub(super) fn says(&self, words: &[&str]) -> bool {
        let beside = self.search.iter().flat_map(|search| &search.files).chain(&self.beside);
        std::iter::once(&self.wgsl).chain(beside).any(|file| file.says(words))
    }
}

impl Search {
    /// The number of targets: the first particles of the cell list.
    pub(super) fn targets(&self, problem: &Problem) -> u32 {
        if self.fixed { problem.capacity } else { self.grid.ahead(problem) }
    }
    /// Binds the fields of the cell list, and excludes fixed particles from the targets.
    pub(super) fn bind(&self, kernel: &mut Kernel) {
        let cells = f64::from(self.grid.count());
        for pass in &mut kernel.passes {
            pass.fields.extend(
                self.sorted.iter().map(|name| self.grid.field(name)).map(|(inside, field)| (inside.into(), field)),
            );
            let ends = pass.constants.iter_mut().filter(|(name, _)| *name == "CELLS" && !self.fixed);
            ends.for_each(|(_, end)| *end = cells);
        }
    }
    /// The field in the order of the cell list with that name, if there is one.
    pub(super) fn field(&self, name: &str) -> Option<Name> {
        self.sorted.iter().find(|sorted| **sorted == name).map(|sorted| self.grid.field(sorted).1)
    }
    /// The slot of each particle in the cell list.
    pub(super) fn slots(&self, host: &Host) -> Result<Vec<Option<usize>>, Error> {
        let mut slots = vec![None; host.world().count as usize];
        for (slot, id) in self.grid.occupants(host)?.into_iter().enumerate() {
            // After the last slot there is data of an earlier build.
            if let Some(place) = slots.get_mut(id as usize).filter(|place| place.is_none()) {
                *place = Some(slot);
            }
        }
        Ok(slots)
    }
    /// The fields in the order of the cell list, by particle; zeros for particles outside it.
    pub(super) fn by_particle(&self, host: &Host) -> Result<Vec<(&'static str, Array)>, Error> {
        let (slots, length) = (self.slots(host)?, host.reading::<u32>(&self.grid.field(SORTED_ID).1)?.len().max(1));
        let ordered = |name: &&'static str| {
            let field = self.grid.field(name).1;
            let mut values =
                host.get(&field).ok_or_else(|| Error::Device(format!("no field `{field}` on the host")))?;
            let width = values.len() / length;
            values.resize(width * (length + 1), [0.0; 4]);
            let order: Vec<usize> = slots.iter().map(|slot| slot.unwrap_or(length)).collect();
            Ok((*name, values.picked(&order, width)))
        };
        self.sorted.iter().map(ordered).collect()
    }
}
