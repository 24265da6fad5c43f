//! Room for more rows: buffers are made anew, the plan is written for them, and all that a step keeps is carried over row by row.

use super::{Simulation, Start};
use crate::error::Error;
use crate::kernel::{Array, Backend, STOP};
use crate::state::KEPT_ROWS;

impl<B: Backend> Simulation<B> {
    /// Makes room for so many rows in all; ids are a column then. The simulation stays as it is until that is done.
    ///
    /// # Errors
    /// [`Error::Limit`] when a device does not hold so many, and what reading and compiling say; nothing has changed then.
    pub(super) async fn grow(&mut self, rows: u32) -> Result<(), Error> {
        let mut state = self.gathered(&[]).await?;
        self.complete(&mut state).await?;
        state.kept.put(KEPT_ROWS, vec![f64::from(self.first_rows)]);
        (state.capacity, state.next) = (Some(rows), self.rows.next());
        let setup = self.setup.with_state(state);
        let mut grown = Self::going(self.backend.alike(rows)?, &setup, Start::Grown)?;
        self.carry(&mut grown).await?;
        grown.generation = self.generation.saturating_add(1);
        grown.begun &= self.begun;
        *self = grown;
        Ok(())
    }
    /// Carries over what no state has: where an adaptive run stops.
    async fn carry(&mut self, to: &mut Self) -> Result<(), Error> {
        if self.adaptive_step.is_some() {
            let stop = self.backend.read(STOP.name, &Array::Uint(Vec::new()), 2).await?;
            to.backend.write(STOP.name, &stop)?;
        }
        Ok(())
    }
}
