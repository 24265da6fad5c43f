//! What is drawn and measured again: a run that stands still is, once.

use std::sync::Arc;

use web_time::Instant;

use super::View;
use crate::error::Error;
use crate::kernel::Backend;

impl<B: Backend> View<B> {
    /// Whether it stands still, and picture and controls show it, so that nothing need be drawn until there is input.
    #[must_use]
    pub fn rests(&self) -> bool {
        self.paused && self.is_drawn() && !self.measures_lack() && self.shown
    }
    /// The size of the picture that is to be seen, and whether it is smooth.
    fn due(&self) -> ([u32; 2], bool) {
        self.recording.as_ref().map_or((self.size, self.paused), |recording| (recording.size, true))
    }
    /// Draws the picture, unless there is one of what there is.
    pub(super) async fn draw(&mut self) -> Result<(), Error> {
        if self.is_drawn() {
            return Ok(());
        }
        self.shown = false;
        let (size, smooth) = self.due();
        let begun = Instant::now();
        match self.stage.draw(size, smooth).await {
            Ok(()) => {
                self.pace.drawn(begun.elapsed());
                self.drawn = true;
            }
            Err(error) => {
                self.undrawn = Some((size, smooth));
                self.refuse(error)?;
            }
        }
        Ok(())
    }
    /// The picture is of another state, or is to be another one.
    pub(super) fn changed(&mut self) {
        (self.drawn, self.undrawn, self.shown) = (false, None, false);
    }
    /// Whether the picture is of what there is, or cannot be drawn.
    fn is_drawn(&self) -> bool {
        let (size, smooth) = self.due();
        self.drawn && self.stage.shows(size, smooth) || self.undrawn == Some((size, smooth))
    }
    /// Whether what is measured of a run that stands still is of another state. Where it has failed there may be none.
    pub(super) fn measures_lack(&self) -> bool {
        let steps = self.stage.simulation.steps();
        self.fault.is_none() && self.measured != Some(steps)
    }
    /// Measures the state, once also where that fails.
    pub(super) async fn measure(&mut self) -> Result<(), Error> {
        (self.measured, self.shown) = (Some(self.stage.simulation.steps()), false);
        let snapshot = Arc::new(self.stage.simulation.snapshot().await?);
        self.plots.take(&snapshot);
        // A film has one scale.
        if self.recording.is_none() && self.stage.follow(&snapshot).await? {
            self.changed();
        }
        self.plots.done();
        Ok(())
    }
}
