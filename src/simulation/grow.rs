//! Room for more rows: buffers are made anew, the plan is written for them, and all that a step keeps is carried over row by row.

use super::{Simulation, Start};
use crate::error::Error;
use crate::kernel::{Array, Backend, STOP};
use crate::neighbors::{HISTORY, LIST, LIST_ORIGIN, LIST_STATE, LIST_STATE_WORDS};
use crate::state::{KEPT_ROOM, KEPT_ROWS};

/// Words of the row of a particle in the list of neighbours.
const LIST_WORDS: usize = 4;

impl<B: Backend> Simulation<B> {
    /// Makes room for so many rows in all; ids are a column then. The simulation stays as it is until that is done.
    ///
    /// # Errors
    /// [`Error::Limit`] when a device does not hold so many, and what reading and compiling say; nothing has changed then.
    pub(super) async fn grow(&mut self, rows: u32) -> Result<(), Error> {
        let mut state = self.gathered(&[]).await?;
        self.complete(&mut state).await?;
        state.kept.put(KEPT_ROWS, vec![f64::from(self.first_rows)]);
        state.kept.put(KEPT_ROOM, self.list.map(|list| f64::from(list.capacity)).into_iter().collect());
        (state.capacity, state.next) = (Some(rows), self.rows.next());
        let setup = self.setup.with_state(state);
        let mut grown = Self::going(self.backend.alike(rows)?, &setup, Start::Grown)?;
        self.carry(&mut grown).await?;
        grown.generation = self.generation.saturating_add(1);
        grown.begun &= self.begun;
        *self = grown;
        Ok(())
    }
    /// Carries over what no state has: the list of neighbours with history of pairs, and where an adaptive run stops.
    async fn carry(&mut self, to: &mut Self) -> Result<(), Error> {
        let (real, whole, four) = (Array::Float(Vec::new()), Array::Uint(Vec::new()), Array::Vec4(Vec::new()));
        if self.adaptive_step.is_some() {
            let stop = self.backend.read(STOP.name, &whole, 2).await?;
            to.backend.write(STOP.name, &stop)?;
        }
        let Some(list) = self.list.filter(|list| list.words > 0) else { return Ok(()) };
        let (old, new) = (self.capacity() as usize, to.capacity() as usize);
        let rows = 1 + list.capacity as usize / LIST_WORDS;
        let words = 2 * list.capacity as usize * list.words as usize;
        let fields = [
            (LIST, &whole, LIST_WORDS, rows),
            (HISTORY, &real, 1, words),
            (LIST_ORIGIN, &four, 1, 1),
            (LIST_STATE, &whole, LIST_STATE_WORDS, 0),
        ];
        for (name, like, each, layers) in fields {
            if layers == 0 {
                let all = self.backend.read(name, like, each).await?;
                to.backend.write(name, &all)?;
                continue;
            }
            let all = self.backend.read(name, like, each * layers * old).await?;
            for layer in 0..layers {
                let part: Vec<usize> = (layer * old..(layer + 1) * old).collect();
                to.backend.write_at(name, each * layer * new, &all.picked(&part, each))?;
            }
        }
        Ok(())
    }
}
