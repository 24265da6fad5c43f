//! The state of a simulation: columns of all particles, and what ties, moves, spawns and removes them. Shapes make it, files
//! hold it, a simulation starts from it and gives it back.

mod append;
mod basic;
mod life;

use crate::error::Error;
use crate::kernel::{Array, Column, Columns, Kind, Role, Shape};
use crate::life::{Birth, Drain};
use crate::links::Links;
use crate::motion::{Held, Motion};

use basic::BASIC;

/// Particles and all that a run needs to go on with them. Every array has one element per particle, in the order of ids. Units
/// are the scene's own.
///
/// Positions, velocities, masses, sizes and species are always there; any other column is there when somebody has given it.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// The basic columns in the order of [`BASIC`], then the others in the order of their names.
    columns: Vec<Filled>,
    /// What ties particles together.
    pub links: Links,
    /// Those that forces do not move.
    pub held: Vec<Held>,
    /// What leads some of those, and solids: [`Hold::Motion`](crate::motion::Hold::Motion) counts them from 0.
    pub motions: Vec<Motion>,
    /// When and how pending particles are spawned.
    pub births: Vec<Birth>,
    /// Where particles are removed.
    pub drains: Vec<Drain>,
    /// The time \[time\].
    pub time: f64,
    /// Steps done.
    pub step: u64,
}

/// A column and its values.
#[derive(Debug, Clone, PartialEq)]
struct Filled {
    column: Column,
    values: Array,
}

impl Filled {
    fn new(column: Column, particles: usize) -> Self {
        let values = column.array(particles);
        Self { column, values }
    }
}

impl Default for State {
    /// No particles, at time 0.
    fn default() -> Self {
        let known = Columns::default();
        let columns = BASIC.iter().filter_map(|name| known.get(name)).map(|column| Filled::new(column.clone(), 0));
        Self {
            columns: columns.collect(),
            links: Links::default(),
            held: Vec::new(),
            motions: Vec::new(),
            births: Vec::new(),
            drains: Vec::new(),
            time: 0.0,
            step: 0,
        }
    }
}

impl State {
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
    /// All columns that it has, with their values.
    pub fn columns(&self) -> impl Iterator<Item = (&Column, &Array)> {
        self.columns.iter().map(|filled| (&filled.column, &filled.values))
    }
    /// The values of a column.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&Array> {
        self.find(name).map(|filled| &filled.values)
    }
    /// The values of a column, to change in place.
    #[must_use]
    pub fn get_mut(&mut self, name: &str) -> Option<&mut Array> {
        self.columns.iter_mut().find(|filled| filled.column.name == name).map(|filled| &mut filled.values)
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
    /// The values of a column of whole numbers.
    #[must_use]
    pub fn whole(&self, name: &str) -> Option<&[u32]> {
        if let Some(Array::Uint(values)) = self.get(name) { Some(values) } else { None }
    }
    /// Adds a column, filled with its initial value. One of the same name that is there keeps its values.
    ///
    /// # Errors
    /// [`Error::Scene`] when the one that is there is of another kind or shape.
    pub fn declare(&mut self, column: &Column) -> Result<(), Error> {
        let count = self.len();
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
            known.column = column.clone();
            return Ok(());
        }
        let after = BASIC.len();
        let place = self.columns[after..].partition_point(|filled| filled.column.name < column.name);
        self.columns.insert(after + place, Filled::new(column.clone(), count));
        Ok(())
    }
    /// Gives a column its values. A name that is not declared yet becomes a column of that kind, one value for each particle.
    ///
    /// # Errors
    /// [`Error::Scene`] when the values are of another kind than the column, or not as many.
    pub fn set(&mut self, name: &str, values: Array) -> Result<(), Error> {
        if self.find(name).is_none() {
            let kind = Kind::of(&values);
            self.declare(&Column::new(name.to_owned(), kind, "", ""))?;
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
                "the column `{name}` takes {wanted} values, and {} are given: give one for each of {count} particles",
                values.len()
            )));
        }
        *old = values;
        Ok(())
    }
    /// Takes a column away. The basic ones stay.
    pub fn remove(&mut self, name: &str) -> Option<Array> {
        let place = self.columns.iter().position(|filled| filled.column.name == name).filter(|n| *n >= BASIC.len())?;
        Some(self.columns.remove(place).values)
    }
    /// The same, without columns that are recomputed.
    #[must_use]
    pub fn without_derived(mut self) -> Self {
        self.columns.retain(|filled| filled.column.role == Role::State);
        self
    }
    fn find(&self, name: &str) -> Option<&Filled> {
        self.columns.iter().find(|filled| filled.column.name == name)
    }
    /// Every column with one value, or some, for each particle.
    fn particle_columns(&mut self) -> impl Iterator<Item = &mut Filled> {
        self.columns.iter_mut().filter(|filled| !matches!(filled.column.shape, Shape::System(_)))
    }
}
