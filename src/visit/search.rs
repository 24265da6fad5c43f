//! The search of a law that belongs to a method with its own fields: in the order of the cell list, or by particle over a kept list.

use std::sync::Arc;

use glam::DVec3;

use super::{Candidate, Law, Outcome, Over, Particle, reference};
use crate::error::Error;
use crate::kernel::{Array, Host, Kernel, Name, Problem, Scalar, Source, World};
use crate::neighbors::{Grid, SORTED_ID};

/// The search of a law, in addition to its range.
#[derive(Clone)]
pub struct Search {
    /// The grid, which holds all particles; none over a kept list.
    pub grid: Option<Grid>,
    /// The data of a neighbour that it loads.
    pub candidate: Candidate,
    /// Fields of the method, by their names in WGSL: in the order of the cell list, or by particle over a kept list. A law's reference
    /// reads and writes them by particle.
    pub fields: Vec<&'static str>,
    /// Files beside the law's own.
    pub files: Vec<Source>,
    /// Values for `override`s, some of which its files may not have.
    pub constants: Vec<(&'static str, f64)>,
    /// Whether fixed particles, which the grid keeps after all others, are targets too. Over a kept list they always are.
    pub fixed: bool,
}

/// What completes an outlined law with a settled visit, in a problem.
pub type Outlined = Arc<dyn Fn(Law, &Problem) -> Result<Law, Error> + Send + Sync>;

/// A field of a method, by its name in shaders: in the order of a grid, or by particle where there is none. No column has a space in its name.
#[must_use]
pub fn placed(grid: Option<&Grid>, name: &'static str) -> (&'static str, Name) {
    grid.map_or_else(|| (name, format!("{name} by particle").into()), |grid| grid.field(name))
}

impl Law {
    /// A law of a method with numbers that depend on the box, such as those of a smoothing kernel on its dimensions: `complete` makes the rest by
    /// [`Law::searched`]. It may write fields of the method that are not columns.
    pub fn outlined(
        name: &str,
        over: Over,
        wgsl: Source,
        into: &[&'static str],
        complete: impl Fn(Self, &Problem) -> Result<Self, Error> + Send + Sync + 'static,
    ) -> Self {
        let into = into.iter().map(|name| Name::from(*name)).collect();
        Self { into, outlined: Some(Arc::new(complete)), ..Self::own(name, over, wgsl, Vec::new()) }
    }
    /// An outlined law with its search, its parameters and its reference, which is that of [`Law::computing`].
    #[must_use]
    pub fn searched<S: Default>(
        self,
        search: Search,
        params: Vec<(&'static str, Scalar)>,
        gather: impl Fn(&Particle, &Particle, DVec3, &World, &mut S) + Send + Sync + 'static,
        finish: impl Fn(&Particle, &S, &World, &mut Outcome) + Send + Sync + 'static,
    ) -> Self {
        let params = params.into_iter().map(|(name, value)| (name.to_owned(), value)).collect();
        let reference = Some(reference::searching(self.over, search.clone(), gather, finish));
        Self { params, reference, search: Some(search), outlined: None, ..self }
    }
    /// A law of a method that searches a grid of its own.
    pub fn searching<S: Default>(
        name: &str,
        grid: &Grid,
        search: Search,
        wgsl: Source,
        into: &[&'static str],
        gather: impl Fn(&Particle, &Particle, DVec3, &World, &mut S) + Send + Sync + 'static,
        finish: impl Fn(&Particle, &S, &World, &mut Outcome) + Send + Sync + 'static,
    ) -> Self {
        let over = Over::Near { range: grid.range, of: None };
        let into = into.iter().map(|name| Name::from(*name)).collect();
        let law = Self { into, ..Self::own(name, over, wgsl, Vec::new()) };
        law.searched(search, Vec::new(), gather, finish)
    }
    /// The same law, complete in a problem.
    pub(super) fn made(self, problem: &Problem) -> Result<Self, Error> {
        let Some(complete) = self.outlined.clone() else { return Ok(self) };
        complete(self, problem)
    }
    /// Its WGSL, and the files beside it.
    pub(super) fn own_files(&self) -> impl Iterator<Item = &Source> {
        let beside = self.search.iter().flat_map(|search| &search.files).chain(&self.beside);
        std::iter::once(&self.wgsl).chain(beside)
    }
    /// Whether one of them defines a function of that name.
    pub(super) fn defines(&self, function: &str) -> bool {
        self.own_files().any(|file| file.defines(function))
    }
}

impl Search {
    /// The number of targets: the first particles of the cell list.
    pub(super) fn targets(&self, problem: &Problem) -> u32 {
        self.grid.as_ref().filter(|_| !self.fixed).map_or(problem.capacity, |grid| grid.ahead(problem))
    }
    /// Binds the fields of the method, and excludes fixed particles from the targets in a cell list.
    pub(super) fn bind(&self, kernel: &mut Kernel) {
        let ahead = self.grid.as_ref().filter(|_| !self.fixed).map(|grid| f64::from(grid.count()));
        for pass in &mut kernel.passes {
            pass.fields.extend(self.fields.iter().filter_map(|name| Some(((*name).into(), self.field(name)?))));
            let ends = pass.constants.iter_mut().filter(|(name, _)| *name == "CELLS");
            ends.zip(ahead).for_each(|((_, end), cells)| *end = cells);
        }
    }
    /// The field of the method with that name, if there is one.
    pub(super) fn field(&self, name: &str) -> Option<Name> {
        let inside = self.fields.iter().find(|inside| **inside == name)?;
        Some(placed(self.grid.as_ref(), inside).1)
    }
    /// The element of a field that each particle has: its slot in the cell list, if it has one, or its index.
    pub(super) fn places(&self, host: &Host) -> Result<Vec<Option<usize>>, Error> {
        let count = host.world().count as usize;
        let Some(grid) = &self.grid else { return Ok((0..count).map(Some).collect()) };
        let mut slots = vec![None; count];
        for (slot, id) in grid.occupants(host)?.into_iter().enumerate() {
            // After the last slot there is data of an earlier build.
            if let Some(place) = slots.get_mut(id as usize).filter(|place| place.is_none()) {
                *place = Some(slot);
            }
        }
        Ok(slots)
    }
    /// The fields of the method, by particle; zeros for particles outside a cell list.
    pub(super) fn by_particle(&self, host: &Host) -> Result<Vec<(&'static str, Array)>, Error> {
        let places = self.places(host)?;
        let length = match &self.grid {
            Some(grid) => host.reading::<u32>(&grid.field(SORTED_ID).1)?.len().max(1),
            None => places.len().max(1),
        };
        let ordered = |name: &&'static str| {
            let field = self.field(name).unwrap_or_default();
            let mut values =
                host.get(&field).ok_or_else(|| Error::Device(format!("no field `{field}` on the host")))?;
            let width = values.len() / length;
            values.resize(width * (length + 1), [0.0; 4]);
            let order: Vec<usize> = places.iter().map(|place| place.unwrap_or(length)).collect();
            Ok((*name, values.picked(&order, width)))
        };
        self.fields.iter().map(ordered).collect()
    }
}
