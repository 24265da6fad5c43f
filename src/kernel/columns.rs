//! The columns of a simulation: those that all have, and those that components and scenes declare.

use super::column::{Column, Kind, Role, Shape};
use crate::error::Error;

/// Buffers of the engine, whose names no column may have.
const RESERVED: [&str; 6] = ["world", "alarm", "params", "grid", "position_low", "velocity_low"];

/// Prefixes of the names of buffers that integrators keep beside columns.
const KEPT: [&str; 4] = ["start_", "slope_", "rate_", "kept_"];

/// The columns of a simulation, in the order of their declaration; every name once.
#[derive(Debug, Clone, PartialEq)]
pub struct Columns(Vec<Column>);

impl Default for Columns {
    fn default() -> Self {
        Self(base())
    }
}

/// The columns of every simulation.
#[must_use]
pub fn base() -> Vec<Column> {
    vec![
        Column::new("position", Kind::Vector, "length", "where the particle is").with_rate("velocity").required(),
        Column::new("mass", Kind::Scalar, "mass", "the mass; 0: a test particle")
            .within("position", 3)
            .starting([1.0, 0.0, 0.0, 0.0]),
        Column::new("velocity", Kind::Vector, "length / time", "how it moves").with_rate("acceleration"),
        Column::new("size", Kind::Scalar, "length", "the radius in pictures; 0: chosen by the picture")
            .within("velocity", 3),
        Column::new("acceleration", Kind::Vector, "length / time²", "the sum of all laws").summed(),
        Column::new(
            "potential",
            Kind::Scalar,
            "length² / time²",
            "its share of the potential energy, per unit of mass",
        )
        .within("acceleration", 3)
        .summed(),
        Column::new("species", Kind::Whole, "", "the species, a number by which laws distinguish particles"),
        Column::new("life", Kind::Whole, "", "its state of life: 0 pending, 1 active, 2 removed")
            .starting([1.0, 0.0, 0.0, 0.0]),
        Column::new("id", Kind::Whole, "", "the number that stays with the particle; its row, where none is given"),
    ]
}

impl Columns {
    /// The base columns and these. A column may be declared by several components, if the declarations are equal.
    ///
    /// # Errors
    /// [`Error::Scene`] when two declarations of one name differ, a name is reserved or not valid in WGSL, a rate is not
    /// declared or of another kind, or a column lies in a buffer that does not hold it.
    pub fn with(declared: impl IntoIterator<Item = Column>) -> Result<Self, Error> {
        let mut columns = Self::default();
        for column in declared {
            columns.add(column)?;
        }
        columns.check()?;
        Ok(columns)
    }
    fn add(&mut self, column: Column) -> Result<(), Error> {
        if let Some(known) = self.get(&column.name) {
            if *known == column {
                return Ok(());
            }
            return Err(Error::Scene(format!(
                "the column `{}` is declared twice, as {} and as {}: give one of them another name",
                column.name,
                known.described(),
                column.described()
            )));
        }
        let mut letters = column.name.chars();
        let good = letters.next().is_some_and(|c| c.is_ascii_alphabetic())
            && letters.all(|c| c.is_ascii_alphanumeric() || c == '_');
        if !good || column.name.len() > 64 {
            return Err(Error::Scene(format!(
                "a column is called `{}`: use letters, digits and `_`, a letter first, 64 of them at most",
                column.name
            )));
        }
        if let Some(kept) = KEPT.iter().find(|kept| column.name.starts_with(**kept)) {
            return Err(Error::Scene(format!(
                "a column is called `{}`, and names that begin with `{kept}` are those of integrators: choose another name",
                column.name
            )));
        }
        if RESERVED.contains(&column.name.as_ref()) {
            return Err(Error::Scene(format!(
                "a column is called `{}`, which is a buffer of the engine: choose another name",
                column.name
            )));
        }
        self.0.push(column);
        Ok(())
    }
    fn check(&self) -> Result<(), Error> {
        for column in &self.0 {
            self.check_rate(column)?;
            self.check_sum(column)?;
        }
        Ok(())
    }
    /// The column of a name.
    #[must_use]
    pub fn get(&self, name: &str) -> Option<&Column> {
        self.0.iter().find(|column| column.name == name)
    }
    /// All of them.
    pub fn iter(&self) -> impl Iterator<Item = &Column> {
        self.0.iter()
    }
    /// Those that lie in a buffer.
    pub fn of_buffer<'a>(&'a self, buffer: &'a str) -> impl Iterator<Item = &'a Column> {
        self.0.iter().filter(move |column| column.place.buffer == buffer)
    }
    /// Those that a state keeps.
    pub fn state(&self) -> impl Iterator<Item = &Column> {
        self.0.iter().filter(|column| column.role == Role::State)
    }
    /// Elements of a buffer of columns, of so many particles; `None` where no column lies there.
    #[must_use]
    pub fn len_of(&self, buffer: &str, particles: usize) -> Option<usize> {
        self.of_buffer(buffer).map(|column| column.shape.len(particles)).max()
    }
    /// Whether every particle has one value in this buffer.
    #[must_use]
    pub fn is_per_particle(&self, buffer: &str) -> bool {
        self.of_buffer(buffer).all(|column| column.shape == Shape::Particle)
    }
}
