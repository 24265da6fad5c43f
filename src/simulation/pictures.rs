//! Pictures of a simulation.

use std::borrow::Cow;

use super::Simulation;
use crate::error::Error;
use crate::kernel::Backend;
use crate::kernel::Shape;
use crate::render::{self, Color, Film, Image, Picture, Scaled, bytes, pack};

impl<B: Backend> Simulation<B> {
    /// Draws the current state. Only the picture is read back.
    ///
    /// # Errors
    /// [`Error::Scene`] when the picture was made for another number of particles, or what drawing says.
    pub async fn draw(&mut self, picture: &Picture) -> Result<Image, Error> {
        self.fits(picture)?;
        self.settle().await?;
        let mut picture = Cow::Borrowed(picture);
        if matches!(picture.color, Color::Column(_)) {
            Box::pin(self.scale(picture.to_mut())).await?;
        }
        render::draw(&mut self.backend, &picture).await
    }
    /// Draws the current state as the next picture of a film.
    ///
    /// # Errors
    /// As for [`Simulation::draw`].
    pub async fn shoot(&mut self, film: &mut Film) -> Result<Image, Error> {
        self.fits(film.picture())?;
        self.settle().await?;
        Box::pin(self.scale(film.picture_mut())).await?;
        film.rescale();
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
        self.scale(&mut live.picture).await?;
        live.draw(&mut self.backend).await
    }
    /// Gives a picture that is coloured by a column the scale of its present values; others stay as they are. A column that is not on the device, because no
    /// kernel uses it, gives each particle a colour of its own. Without this a picture has a scale of its own each time it is drawn.
    ///
    /// # Errors
    /// [`Error::Scene`] when there is no such column, nothing computes it, or it has several values for each particle; and when the device is lost, out of
    /// memory or does not answer in time.
    pub async fn scale(&mut self, picture: &mut Picture) -> Result<(), Error> {
        let Color::Column(name) = &picture.color else { return Ok(()) };
        let column = self.store.named(name)?.clone();
        if column.shape != Shape::Particle {
            return Err(Error::Scene(format!(
                "the column `{name}` has not one value for each particle, so that no colours can show it"
            )));
        }
        let on_device = self.store.lies_on_device(&column);
        // Of a derived column only a measurement has the values of the present state.
        let state = self.snapshot_of(&[&column.name]).await?;
        let fixed = state.fixed();
        let values = state.get(&column.name).map(Scaled::sizes).unwrap_or_default();
        // Walls are not what one looks at, where there is anything else.
        let free = values.iter().zip(&fixed).filter(|(_, fixed)| !**fixed).map(|(value, _)| *value);
        let free: Vec<f64> = free.collect();
        // By rows, which a state may have in another order, or not have at all.
        let rows = if on_device && !values.is_empty() {
            Vec::new()
        } else {
            Scaled::sizes(&self.read_column(&column.name).await?)
        };
        let shown = [&free, &values, &rows].into_iter().find(|values| !values.is_empty());
        let scaled = Scaled::of(column, shown.into_iter().flatten().copied());
        picture.paint(if on_device {
            Color::Value(Box::new(scaled))
        } else {
            Color::Given(rows.iter().map(|x| pack(bytes(scaled.color(*x)))).collect())
        });
        Ok(())
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
