//! Which particle is in which row.

use super::Simulation;
use crate::kernel::Backend;
use crate::state::State;

/// The particles in the rows of a simulation.
pub(super) struct Rows {
    /// The id of each row, where ids are not rows.
    ids: Option<Vec<u32>>,
}

impl Rows {
    /// Those of a state.
    pub fn of(state: &State) -> Self {
        Self { ids: state.has_ids().then(|| state.ids().into_owned()) }
    }
    /// The id of the particle in a row.
    pub fn id(&self, row: u32) -> u32 {
        self.ids.as_ref().and_then(|ids| ids.get(row as usize).copied()).unwrap_or(row)
    }
}

impl<B: Backend> Simulation<B> {
    /// The ids of particles, row by row, as [`Simulation::read`] gives their values.
    #[must_use]
    pub fn ids(&self) -> Vec<u32> {
        (0..self.count()).map(|row| self.rows.id(row)).collect()
    }
    /// The name by which messages know the particle in a row.
    pub(super) fn named(&self, row: u32) -> u32 {
        self.rows.id(row)
    }
}
