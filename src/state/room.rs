//! Free rows: a state with room for particles to come.

use glam::DVec3;

use super::State;
use crate::kernel::{Array, Columns, ID, LIFE, Shape, extent};
use crate::life::Life;

/// The id of a free row.
pub(crate) const NONE: u32 = u32::MAX;

/// Whole multiples of these, folded into a unit cube, fill it evenly (Roberts 2018, R₃): no two are the same.
const EVENLY: DVec3 = DVec3::new(0.819_172_513_396_164_4, 0.671_043_606_703_789_2, 0.549_700_477_901_970_3);

impl State {
    /// The number of rows of a simulation made from it.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.len().max(self.capacity.map_or(0, |rows| rows as usize))
    }
    /// The same state with free rows after its particles, where it has a capacity and no free rows yet: removed, and without mass. They lie
    /// between the particles, no two at the same position.
    pub(crate) fn padded(&self) -> Option<Self> {
        if self.capacity.is_none() || self.free.is_some() {
            return None;
        }
        let (count, rows) = (self.len(), self.rows());
        let free = rows - count;
        let extent = extent(self.position());
        let (kept, next) = (self.kept.clone(), self.next_id());
        let mut state = self.clone();
        let ids = self.ids().iter().copied().chain(std::iter::repeat_n(NONE, free)).collect();
        let life = self.life();
        let life = (0..count).map(|place| life.get(place).copied().unwrap_or_default().word());
        let life = life.chain(std::iter::repeat_n(Life::Removed.word(), free)).collect();
        let declared: Vec<_> = state.declared().cloned().collect();
        for column in declared.iter().filter(|column| !matches!(column.shape, Shape::System(_))) {
            if let Some(values) = state.get_mut(&column.name) {
                values.resize(column.shape.len(rows), column.initial.unwrap_or_default());
            }
        }
        let known = Columns::default();
        for (name, words) in [(ID.name, ids), (LIFE.name, life)] {
            if let Some(column) = known.get(name) {
                state.put(column, Some(Array::Uint(words)));
            }
        }
        for (row, x) in state.position_mut().iter_mut().enumerate().skip(count) {
            *x = parked(extent, u32::try_from(row).unwrap_or(u32::MAX));
        }
        state.mass_mut()[count..].fill(0.0);
        (state.kept, state.next, state.free) = (kept, next, Some(u32::try_from(free).unwrap_or(u32::MAX)));
        Some(state)
    }
    /// The number of free rows at the end.
    pub(crate) fn free_rows(&self) -> u32 {
        self.free.unwrap_or(0)
    }
}

/// The position of a free row between two corners \[length\]: attraction without softening requires distinct positions, even of particles
/// without mass.
pub(crate) fn parked((low, high): (DVec3, DVec3), row: u32) -> DVec3 {
    low + (high - low) * (0.5 + f64::from(row) * EVENLY).fract()
}
