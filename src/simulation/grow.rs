//! Room for more rows, or for more neighbours of each particle: buffers are recreated, the plan is rewritten for them, and all restart data
//! of a step is copied row by row.

use super::elastic::Change;
use super::{Simulation, Start};
use crate::error::Error;
use crate::kernel::{Array, Backend, STOP};
use crate::state::{KEPT_MOST, KEPT_PART, KEPT_ROOM, KEPT_ROWS, KEPT_SKIN};

/// The capacity to provide.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Room {
    /// This many rows in all; ids are then a column.
    Rows(u32),
    /// This many neighbours of each particle on the list.
    Neighbors(u32),
    /// As many neighbours as there are within the range and this skin \[length\].
    Skin(f64),
    /// Cells of the present box that are wide enough for sides of a part of their length, and waves enough for a multiple of it.
    Box(Change),
}

impl<B: Backend> Simulation<B> {
    /// Increases the capacity. The simulation is unchanged until that is complete.
    ///
    /// # Errors
    /// [`Error::Limit`] when a device does not hold so many, and errors of reading and compiling; nothing has changed then.
    pub(super) async fn grow(&mut self, room: Room) -> Result<(), Error> {
        let keep = self.backend.compile(&self.plans.keep)?;
        self.backend.run(&keep, 1)?;
        let mut state = self.gathered(&[]).await?;
        self.complete(&mut state).await?;
        let rows = match room {
            Room::Rows(rows) => Some(rows),
            Room::Neighbors(_) | Room::Skin(_) | Room::Box(_) => Some(self.capacity()).filter(|_| self.rows.are_open()),
        };
        if rows.is_some() {
            state.kept.put(KEPT_ROWS, vec![f64::from(self.first_rows)]);
            (state.capacity, state.next) = (rows, self.rows.next());
        }
        let neighbors = match room {
            Room::Rows(_) | Room::Box(_) => self.list.map(|list| list.capacity),
            Room::Neighbors(neighbors) => Some(neighbors),
            Room::Skin(_) => None,
        };
        let skin = match room {
            Room::Skin(skin) => Some(skin),
            _ => self.problem.skin,
        };
        state.kept.put(KEPT_SKIN, skin.into_iter().collect());
        state.kept.put(KEPT_ROOM, neighbors.map(f64::from).into_iter().collect());
        if let Room::Box(change) = room {
            state.kept.put(KEPT_PART, vec![change.least]);
            state.kept.put(KEPT_MOST, vec![change.most]);
        }
        let setup = self.setup.with_state(state);
        let mut grown = Self::going(self.backend.alike(rows.unwrap_or(self.capacity()))?, &setup, Start::Grown)?;
        self.carry(&mut grown).await?;
        grown.generation = self.generation.saturating_add(1);
        grown.begun &= self.begun;
        grown.goes_on = self.goes_on;
        grown.skin = self.skin.after(self.steps);
        *self = grown;
        Ok(())
    }
    /// Copies the data that no state holds: the stop of an adaptive run.
    async fn carry(&mut self, to: &mut Self) -> Result<(), Error> {
        if self.adaptive_step.is_some() {
            let stop = self.backend.read(STOP.name, &Array::Uint(Vec::new()), 2).await?;
            to.backend.write(STOP.name, &stop)?;
        }
        Ok(())
    }
}
