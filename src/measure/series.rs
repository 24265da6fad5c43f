//! A measure in the course of a run: the state of each output gives rows of a table.

use std::any::Any;
use std::fmt::{self, Debug, Display};
use std::sync::Arc;

use crate::error::Error;
use crate::kernel::Bounds;
use crate::links::Links;
use crate::simulation::{Clock, Setup};
use crate::state::State;

/// The state of an output, with further data.
#[derive(Debug, Clone, Copy)]
pub struct Moment<'a> {
    /// The state, which is shared with writers that use a thread of their own. For a measure it has the column `potential`.
    pub state: &'a Arc<State>,
    /// The densities of a fluid, by row; empty where no measure needs them.
    pub density: &'a [f32],
    /// The clock, where steps are adaptive.
    pub clock: Option<&'a Clock>,
    /// The remaining links, where they may break.
    pub links: Option<&'a Links>,
    /// The virial −½ Σ r ⊗ F of forces of pairs, where a measure needs it: xx, yy, zz, yz, xz, xy \[energy\].
    pub virial: Option<[f64; 6]>,
}

impl Moment<'_> {
    /// The box of the state, which is this one where no barostat has changed it.
    #[must_use]
    pub fn bounds(&self, bounds: &Bounds) -> Bounds {
        self.state.boxed(bounds)
    }
}

/// What a measure reads beside the state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Needs {
    /// The densities of a fluid.
    pub density: bool,
    /// The virial of forces of pairs.
    pub virial: bool,
}

/// A measure in the course of a run.
pub trait Series: Any + Debug + Send + Sync {
    /// Measures a state. Returns the rows of its table, without step and time; most measures have one for each state.
    ///
    /// # Errors
    /// [`Error::Scene`] where the state lacks a column that it reads.
    fn take(&mut self, moment: &Moment<'_>) -> Result<Vec<Row>, Error>;
    /// Reads back a row that it returned before the run was stopped: the cells after the step, so that the time is the first.
    fn recall(&mut self, step: u64, cells: &[&str]);
    /// What it reads beside the state.
    fn needs(&self) -> Needs {
        Needs::default()
    }
    /// Forces were [set](crate::Simulation::set): goes on with those of this setup, which has no state.
    ///
    /// # Errors
    /// [`Error::Scene`] when they are none that it measures.
    fn follow(&mut self, _setup: &Setup) -> Result<(), Error> {
        Ok(())
    }
    /// A line for the end of a run.
    fn summary(&self) -> Option<String> {
        None
    }
    /// The first fault that the last state has shown, if there is a new one.
    fn warning(&mut self) -> Option<String> {
        None
    }
}

/// A row of a table, without step and time.
pub type Row = Vec<Cell>;

/// A cell of a table.
#[derive(Debug, Clone, PartialEq)]
pub enum Cell {
    /// A number, with the digits that read back to the same bits.
    Number(f64),
    /// A count, or an id.
    Whole(u64),
    /// A word without commas.
    Word(&'static str),
    /// An empty cell.
    Empty,
}

impl Display for Cell {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(x) => write!(f, "{x:?}"),
            Self::Whole(n) => write!(f, "{n}"),
            Self::Word(word) => f.write_str(word),
            Self::Empty => Ok(()),
        }
    }
}
impl From<f64> for Cell {
    fn from(x: f64) -> Self {
        Self::Number(x)
    }
}
impl From<u64> for Cell {
    fn from(n: u64) -> Self {
        Self::Whole(n)
    }
}
impl From<u32> for Cell {
    fn from(n: u32) -> Self {
        Self::Whole(n.into())
    }
}
impl From<&'static str> for Cell {
    fn from(word: &'static str) -> Self {
        Self::Word(word)
    }
}

/// The number in a cell of a table; NaN where there is none.
pub(super) fn number(cells: &[&str], k: usize) -> f64 {
    cells.get(k).and_then(|word| word.parse().ok()).unwrap_or(f64::NAN)
}

/// The count in a cell of a table; 0 where there is none.
pub(super) fn whole(cells: &[&str], k: usize) -> u64 {
    cells.get(k).and_then(|word| word.parse().ok()).unwrap_or_default()
}
