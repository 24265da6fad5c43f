//! The assignment of particles to rows, and the free rows. Rows are reused, and ids are not.

use std::collections::{BTreeMap, BTreeSet};

use super::Simulation;
use crate::kernel::Backend;
use crate::state::{NONE, State};

/// The particles in the rows of a simulation.
pub(super) struct Rows {
    /// The id of each row, where ids are not rows; [`NONE`] in free ones.
    ids: Option<Vec<u32>>,
    /// The row of each id, likewise.
    places: BTreeMap<u32, u32>,
    free: BTreeSet<u32>,
    /// Rows from here on have never been in use.
    used: u32,
    /// Whether rows may be free.
    open: bool,
    /// The number of rows.
    capacity: u32,
    /// All ids from here on are unused.
    next: u32,
}

impl Rows {
    /// The rows of a state that has a particle, or a free row, for each of them.
    pub fn of(state: &State, capacity: u32) -> Self {
        let used = capacity.saturating_sub(state.free_rows());
        let ids = state.has_ids().then(|| state.ids().into_owned());
        let named = ids.iter().flatten().copied().zip(0..).filter(|(id, _)| *id != NONE).collect();
        let free = ids.iter().flatten().zip(0..).filter(|(id, _)| **id == NONE).map(|(_, row)| row).collect();
        Self { places: named, ids, free, used, open: state.capacity.is_some(), capacity, next: state.next_id() }
    }
    /// The number of rows.
    pub fn capacity(&self) -> u32 {
        self.capacity
    }
    /// The number of rows that are or were in use: those after them are free.
    pub fn used(&self) -> u32 {
        self.used
    }
    /// Whether particles can come and go: rows may be free, and ids are a column.
    pub fn are_open(&self) -> bool {
        self.open
    }
    /// The id of the particle in a row; an index that is no row is returned unchanged.
    pub fn id(&self, row: u32) -> u32 {
        self.ids.as_ref().map_or(row, |ids| ids.get(row as usize).copied().unwrap_or(NONE))
    }
    /// The row of a particle.
    pub fn row(&self, id: u32) -> Option<u32> {
        if self.ids.is_some() { self.places.get(&id).copied() } else { Some(id).filter(|row| *row < self.capacity) }
    }
    /// Whether a row is free.
    pub fn is_free(&self, row: u32) -> bool {
        self.free.contains(&row)
    }
    /// The number of free rows.
    pub fn room(&self) -> usize {
        self.free.len()
    }
    /// The id that the next particle gets.
    pub fn next(&self) -> u32 {
        self.next
    }
    /// The lowest `count` free rows.
    pub fn lowest(&self, count: usize) -> Vec<u32> {
        self.free.iter().copied().take(count).collect()
    }
    /// Puts particles into rows.
    pub fn fill(&mut self, rows: &[u32], ids: &[u32]) {
        for (row, id) in rows.iter().zip(ids) {
            self.free.remove(row);
            self.used = self.used.max(row.saturating_add(1));
            self.places.insert(*id, *row);
            self.ids.iter_mut().filter_map(|ids| ids.get_mut(*row as usize)).for_each(|place| *place = *id);
            self.next = self.next.max(id.saturating_add(1));
        }
    }
    /// Frees rows.
    pub fn clear(&mut self, rows: &[u32]) {
        for row in rows {
            let id = self.id(*row);
            self.places.remove(&id);
            self.free.insert(*row);
            self.ids.iter_mut().filter_map(|ids| ids.get_mut(*row as usize)).for_each(|place| *place = NONE);
        }
    }
}

impl<B: Backend> Simulation<B> {
    /// The ids of particles, row by row, as [`Simulation::read`] gives their values; `None` in free rows.
    #[must_use]
    pub fn ids(&self) -> Vec<Option<u32>> {
        (0..self.count()).map(|row| Some(self.rows.id(row)).filter(|id| *id != NONE)).collect()
    }
    /// The row of a particle, as [`Simulation::read`] counts them; `None` where it is unknown, or has been removed. Its row stays the
    /// same while it takes part.
    #[must_use]
    pub fn row_of(&self, id: u32) -> Option<u32> {
        self.rows.row(id)
    }
    /// The id of the particle in a row, for messages.
    pub(super) fn named(&self, row: u32) -> u32 {
        match self.rows.id(row) {
            NONE => row,
            id => id,
        }
    }
}
