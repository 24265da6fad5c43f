//! How many live.

use super::Simulation;
use crate::error::Error;
use crate::kernel::{Backend, LIFE};
use crate::life::{Life, Population};

impl<B: Backend> Simulation<B> {
    /// Whether each is active; empty, where all are all the time.
    pub(super) async fn is_active(&mut self) -> Result<Vec<Life>, Error> {
        let words = if self.inactive > 0 { self.read(LIFE).await? } else { Vec::new() };
        Ok(words.into_iter().filter_map(Life::of).collect())
    }
    /// How many are pending, active and removed. Particles due at the start are spawned when the first step begins.
    ///
    /// # Errors
    /// What reading says.
    pub async fn population(&mut self) -> Result<Population, Error> {
        let count = self.count as usize;
        Ok(Population::of(&self.is_active().await?, count))
    }
}
