//! Measures of a state, in f64: a register, a file for each. A run writes a table of each measure that it takes.

mod blocks;
mod region;
mod series;

use std::fmt::{self, Debug};

pub use diffusion::Diffusion;
pub use energy::{Energies, Energy};
pub use flock::{Flock, Flocks};
pub use fluid::{Book, Ledger};
pub use heat_capacity::{Ensemble, Estimate, HeatCapacity};
pub use population::Counts;
pub use pressure::Pressures;
pub use series::{Cell, Moment, Needs, Row, Series};
pub use thermo::Thermo;

use crate::error::Error;
use crate::settings::{Key, Settings};
use crate::simulation::Setup;

/// A measure: its name in scenes, and the table that a run writes of it, `NAME.csv`.
pub struct Measure {
    /// Its name in scenes, and the stem of its table.
    pub name: &'static str,
    /// A description in one line.
    pub about: &'static str,
    /// Its settings.
    pub keys: &'static [Key],
    /// The cells of a row after step and time, each with its meaning and its unit.
    pub cells: &'static [(&'static str, &'static str)],
    /// When it is taken.
    pub times: Times,
    /// The settings with which a run takes it by default; `None` if it does not.
    pub usual: fn(&Setup) -> Result<Option<Settings>, Error>,
    /// Begins a series of it.
    ///
    /// # Errors
    /// [`Error::Setting`] and [`Error::Scene`] where the run has nothing to measure.
    pub begin: Begin,
}

/// When a measure is taken.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Times {
    /// At each output, or every so many steps.
    Chosen,
    /// At each output only.
    Outputs,
    /// As chosen, or after each step in a run with [a ledger](crate::run::Options::ledger).
    Ledger,
}

/// A function that begins a series of a run with such settings.
pub type Begin = fn(&Setup, &Settings) -> Result<Box<dyn Series>, Error>;

impl Measure {
    /// The first line of its table.
    #[must_use]
    pub fn header(&self) -> String {
        self.cells.iter().fold("step,time".to_owned(), |line, (name, _)| line + "," + name)
    }
}

impl Debug for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.name)
    }
}

impl PartialEq for Measure {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}
impl Eq for Measure {}

macro_rules! register {
    ($($module:ident)*) => {
        $(mod $module;)*
        /// All measures, in the order in which a run takes them.
        pub const MEASURES: &[Measure] = &[$($module::MEASURE),*];
    };
}

register! {
    energy
    flock
    granular
    packing
    stress
    fluid
    population
    thermo
    heat_capacity
    pressure
    tail
    rdf
    structure_factor
    haloes
    diffusion
    expansion
    probe
}

/// The measure of that name.
#[must_use]
pub fn measure(name: &str) -> Option<&'static Measure> {
    MEASURES.iter().find(|measure| measure.name == name)
}
