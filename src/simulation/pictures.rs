//! Pictures of a simulation.

use super::Simulation;
use crate::error::Error;
use crate::kernel::Backend;
use crate::render::{self, Film, Image, Picture};

impl<B: Backend> Simulation<B> {
    /// Draws the current state. Only the picture is read back.
    ///
    /// # Errors
    /// [`Error::Scene`] when the picture was made for another number of particles, or what drawing says.
    pub async fn draw(&mut self, picture: &Picture) -> Result<Image, Error> {
        self.fits(picture)?;
        self.settle().await?;
        render::draw(&mut self.backend, picture).await
    }
    /// Draws the current state as the next picture of a film.
    ///
    /// # Errors
    /// As for [`Simulation::draw`].
    pub async fn shoot(&mut self, film: &mut Film) -> Result<Image, Error> {
        self.fits(film.picture())?;
        self.settle().await?;
        render::shoot(&mut self.backend, film).await
    }
    /// Draws the current state into a field of the device, and reads nothing back of it.
    ///
    /// # Errors
    /// As for [`Simulation::draw`].
    #[cfg(feature = "panel")]
    pub async fn show(&mut self, live: &mut render::Live) -> Result<(), Error> {
        self.fits(&live.picture)?;
        self.settle().await?;
        live.draw(&mut self.backend).await
    }
    fn fits(&self, picture: &Picture) -> Result<(), Error> {
        if picture.frame.count != self.capacity() {
            let (made, have) = (picture.frame.count, self.capacity());
            return Err(Error::Scene(format!(
                "a picture of {made} particles cannot be drawn of {have}: make a new one"
            )));
        }
        Ok(())
    }
}
