//! The number of pending, active and removed particles.

use super::Simulation;
use crate::error::Error;
use crate::kernel::{Backend, LIFE};
use crate::life::{Life, Population};

impl<B: Backend> Simulation<B> {
    /// The life of each particle; empty where all particles are always active.
    pub(super) async fn life(&mut self) -> Result<Vec<Life>, Error> {
        let words = if self.inactive > 0 { self.read(LIFE).await? } else { Vec::new() };
        Ok(words.into_iter().filter_map(Life::of).collect())
    }
    /// The numbers of pending, active and removed particles; particles whose rows are free are not counted. Particles due at the start are spawned when the first step begins.
    ///
    /// # Errors
    /// Errors of reading.
    pub async fn population(&mut self) -> Result<Population, Error> {
        let free = |row: &usize| self.rows.is_free(u32::try_from(*row).unwrap_or(u32::MAX));
        let rows: Vec<usize> = (0..self.count() as usize).filter(|row| !free(row)).collect();
        let life = self.life().await?;
        let life: Vec<Life> = rows.iter().filter_map(|row| life.get(*row).copied()).collect();
        Ok(Population::of(&life, rows.len()))
    }
}
