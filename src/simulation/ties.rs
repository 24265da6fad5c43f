//! What is left of the links of a simulation.

use super::Simulation;
use crate::error::Error;
use crate::kernel::{Array, Backend, Element};
use crate::links::{Links, Network, WORDS};
use crate::visit::LINK;

impl<B: Backend> Simulation<B> {
    /// The links as they are now, where springs may break; nothing where none can.
    ///
    /// # Errors
    /// As for [`Simulation::links`].
    pub async fn torn(&mut self) -> Result<Option<Links>, Error> {
        if self.breaks { self.links().await.map(Some) } else { Ok(None) }
    }
    /// The links as they are now: those of the setup, without the springs that broke. They may go into another setup,
    /// which goes on from here.
    ///
    /// # Errors
    /// When the device is lost, or does not answer in time.
    pub async fn links(&mut self) -> Result<Links, Error> {
        if !self.breaks {
            return Ok(self.links.clone());
        }
        let network = Network::new(self.count, &self.links);
        let ends = network.ends() as usize;
        let table = self.backend.read(LINK, &Array::Uint(Vec::new()), ends * WORDS).await?;
        Ok(self.links.intact(&network, u32::view(&table).map_or(&[], Vec::as_slice)))
    }
}
