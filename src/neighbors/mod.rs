//! Neighbours: a cell list, built on the device at each evaluation, independent of laws.

mod build;
mod cells;
mod grid;
mod list;

pub use cells::Cells;
pub use grid::{Grid, checked};
pub(crate) use list::NONE;
pub use list::{EXCLUDED, EXCLUDED_START, HISTORY, LIST, LIST_ORIGIN, LIST_STATE, LIST_STATE_WORDS, List, exclusions};

use crate::kernel::{Field, Name};

/// A field of one grid: several grids have the same fields under names of their own.
fn field(of: &str, grid: &str) -> Name {
    format!("{of} of {grid}").into()
}

/// The start of each cell's particles in the sorted fields; one more than there are cells, for the end of the last.
pub(crate) const STARTS: &str = "starts";
/// Ids, cell by cell, ascending in each cell.
pub(crate) const SORTED_ID: &str = "sorted_id";
/// Positions and masses in that order.
pub(crate) const SORTED_POSITION: &str = "sorted_position";
/// Velocities and radii in that order, where a law reads them.
pub(crate) const SORTED_VELOCITY: &str = "sorted_velocity";

/// Temporary fields of the construction: all grids share them.
const KEYS: Field<u32> = Field::new("keys");
const ARRIVALS: Field<u32> = Field::new("arrivals");
const SLOTS: Field<u32> = Field::new("slots");
