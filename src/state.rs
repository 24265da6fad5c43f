//! The state of a simulation: columns of all particles, and links, motions, births and drains. Shapes make it, files
//! hold it, a simulation starts from it and gives it back.

mod append;
mod basic;
mod ids;
mod kept;
mod life;
mod room;

use std::sync::Arc;

use crate::error::Error;
use crate::floor_plan::FloorPlan;
use crate::kernel::{Array, Column, Columns, Kind, Shape};
use crate::life::{Birth, Drain};
use crate::links::Links;
use crate::motion::{Held, Motion};

use basic::BASIC;
pub(crate) use ids::distinct;
use kept::Kept;
#[cfg(feature = "scene")]
pub(crate) use kept::NEXT as KEPT_NEXT;
pub(crate) use kept::{
    BROKEN as KEPT_BROKEN, EXTENT as KEPT_EXTENT, HOME as KEPT_HOME, KEPT, MOST as KEPT_MOST,
    NEIGHBORS as KEPT_NEIGHBORS, PAIR_WORDS as KEPT_PAIR_WORDS, PAIRS as KEPT_PAIRS, PART as KEPT_PART,
    ROOM as KEPT_ROOM, ROWS as KEPT_ROWS, SIDES as KEPT_SIDES, SKIN as KEPT_SKIN, STEP as KEPT_STEP,
};
pub(crate) use room::{NONE, parked};

/// Particles and all that a run needs to continue with them. Every array has one element per particle, in the order of ids. Units
/// are the scene's own.
///
/// Positions, velocities, masses, sizes and species are always there; any other column has values when some are given.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// The basic columns in the order of [`BASIC`], then the others in the order of their names.
    columns: Vec<Filled>,
    /// Links between particles.
    pub links: Links,
    /// Fixed and kinematic particles.
    pub held: Vec<Held>,
    /// The motions of kinematic particles and obstacles: [`Hold::Motion`](crate::motion::Hold::Motion) counts them from 0.
    pub motions: Vec<Motion>,
    /// When and how pending particles are spawned.
    pub births: Vec<Birth>,
    /// The drains, which remove particles.
    pub drains: Vec<Drain>,
    /// The floor plan, if there is one.
    pub floor_plan: Option<Arc<FloorPlan>>,
    /// The time \[time\].
    pub time: f64,
    /// Steps done.
    pub step: u64,
    /// The number of rows to allocate, so that particles can be spawned without a new plan; `None`: one for each particle, and a
    /// simulation allocates more when it needs them.
    pub capacity: Option<u32>,
    /// The number of free rows at the end, where these have been added.
    pub(crate) free: Option<u32>,
    /// The next id: it and all larger ones are unused.
    pub(crate) next: u32,
    /// Restart data of the last step.
    pub(crate) kept: Kept,
}

/// A column, and its values where some are given.
#[derive(Debug, Clone, PartialEq)]
struct Filled {
    column: Column,
    values: Option<Array>,
}

impl Default for State {
    /// No particles, at time 0.
    fn default() -> Self {
        let known = Columns::default();
        let columns = BASIC
            .iter()
            .filter_map(|name| known.get(name))
            .map(|column| Filled { column: column.clone(), values: Some(column.array(0)) });
        Self {
            columns: columns.collect(),
            links: Links::default(),
            held: Vec::new(),
            motions: Vec::new(),
            births: Vec::new(),
            drains: Vec::new(),
            floor_plan: None,
            time: 0.0,
            step: 0,
            capacity: None,
            free: None,
            next: 0,
            kept: Kept::default(),
        }
    }
}

impl State {
    /// The same on a floor plan, where pedestrians leave at its exits.
    #[must_use]
    pub fn on_floor(mut self, plan: FloorPlan) -> Self {
        self.drains.extend(plan.drains());
        self.floor_plan = Some(Arc::new(plan));
        self
    }
    /// Number of particles.
    #[must_use]
    pub fn len(&self) -> usize {
        self.position().len()
    }
    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
    /// All columns that have values, with these.
    pub fn columns(&self) -> impl Iterator<Item = (&Column, &Array)> {
        self.columns.iter().filter_map(|filled| Some((&filled.column, filled.values.as_ref()?)))
    }
    /// All declared columns, with or without values.
    pub fn declared(&self) -> impl Iterator<Item = &Column> {
        self.columns.iter().map(|filled| &filled.column)
    }
    /// The values of a column, where some are given.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&Array> {
        self.find(name)?.values.as_ref()
    }
    /// The values of a column, to change in place.
    #[must_use]
    pub fn get_mut(&mut self, name: &str) -> Option<&mut Array> {
        self.kept.touched();
        self.columns.iter_mut().find(|filled| filled.column.name == name)?.values.as_mut()
    }
    /// The values of a column of real numbers.
    #[must_use]
    pub fn scalar(&self, name: &str) -> Option<&[f64]> {
        if let Some(Array::Float(values)) = self.get(name) { Some(values) } else { None }
    }
    /// The values of a column of vectors.
    #[must_use]
    pub fn vector(&self, name: &str) -> Option<&[glam::DVec3]> {
        if let Some(Array::Vec3(values)) = self.get(name) { Some(values) } else { None }
    }
    /// The values of a column of integers.
    #[must_use]
    pub fn whole(&self, name: &str) -> Option<&[u32]> {
        if let Some(Array::Uint(values)) = self.get(name) { Some(values) } else { None }
    }
    /// Makes a column known. It gets values by [`State::set`]; a simulation starts with its initial value where none is given.
    ///
    /// # Errors
    /// [`Error::Scene`] when a column of that name with another kind or shape is declared.
    pub fn declare(&mut self, column: &Column) -> Result<(), Error> {
        if let Some(known) = self.columns.iter_mut().find(|filled| filled.column.name == column.name) {
            if (known.column.kind, known.column.shape) != (column.kind, column.shape) {
                return Err(Error::Scene(format!(
                    "the column `{}` is declared as {} ({:?}), and the state has it as {} ({:?}): give one of them another name",
                    column.name,
                    column.kind.name(),
                    column.shape,
                    known.column.kind.name(),
                    known.column.shape
                )));
            }
            return Ok(());
        }
        self.put(column, None);
        Ok(())
    }
    /// Gives a column its values. A name that is not declared yet becomes a column of that kind, one value for each particle.
    ///
    /// # Errors
    /// [`Error::Scene`] when the values are of another kind than the column, or their number differs.
    pub fn set(&mut self, name: &str, values: Array) -> Result<(), Error> {
        if self.find(name).is_none() {
            let known = Columns::default().get(name).cloned();
            let column = known.unwrap_or_else(|| Column::new(name.to_owned(), Kind::of(&values), "", ""));
            self.declare(&column)?;
        }
        let count = self.len();
        let known = self.columns.iter_mut().find(|filled| filled.column.name == name);
        let Some(Filled { column, values: old }) = known else { return Ok(()) };
        if Kind::of(&values) != column.kind {
            return Err(Error::Scene(format!(
                "the column `{name}` is {}, and the values are {}: give it numbers of its kind",
                column.kind.name(),
                Kind::of(&values).name()
            )));
        }
        let wanted = column.shape.len(count);
        if values.len() != wanted {
            return Err(Error::Scene(format!(
                "the column `{name}` takes {wanted} values, and {} are given; there are {count} particles",
                values.len()
            )));
        }
        if old.as_ref() != Some(&values) {
            self.kept.touched();
        }
        *old = Some(values);
        Ok(())
    }
    /// Removes a column, and returns its values. Basic columns cannot be removed.
    pub fn remove(&mut self, name: &str) -> Option<Array> {
        let place = self.columns.iter().position(|filled| filled.column.name == name).filter(|n| *n >= BASIC.len())?;
        self.columns.remove(place).values
    }
    /// Replaces the column of that name; there must be as many values as its shape requires.
    pub(crate) fn put(&mut self, column: &Column, values: Option<Array>) {
        let filled = Filled { column: column.clone(), values };
        if let Some(place) = self.columns.iter().position(|known| known.column.name == column.name) {
            self.columns[place] = filled;
        } else {
            let after = BASIC.len();
            let place = self.columns[after..].partition_point(|known| known.column.name < column.name);
            self.columns.insert(after + place, filled);
        }
    }
    fn find(&self, name: &str) -> Option<&Filled> {
        self.columns.iter().find(|filled| filled.column.name == name)
    }
    /// Every column with values, of shape particle or slots.
    fn particle_columns(&mut self) -> impl Iterator<Item = (&Column, &mut Array)> {
        let some = self.columns.iter_mut().filter(|filled| !matches!(filled.column.shape, Shape::System(_)));
        some.filter_map(|filled| Some((&filled.column, filled.values.as_mut()?)))
    }
}
