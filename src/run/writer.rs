//! Writers, which receive the states of a run.

use std::sync::Arc;

use super::Folder;
use super::table::{Lengths, Table};
use crate::error::Error;
use crate::measure::Moment;
use crate::render::{Image, Picture};

/// Receives the state of every output of a run, and writes a table, a file of particles or a picture, or displays it.
pub trait Writer: Send + Sync {
    /// Opens its files in the folder of the run. Where the run continues, `past` contains the lengths of its tables.
    ///
    /// # Errors
    /// [`Error::Output`] when a file cannot be made.
    fn open(&mut self, folder: &Arc<Folder>, past: &Lengths) -> Result<(), Error> {
        let _ = (folder, past);
        Ok(())
    }
    /// Receives a state.
    ///
    /// # Errors
    /// [`Error::Output`] when it cannot be written, or another error of the writer.
    fn take(&mut self, moment: &Moment<'_>) -> Result<(), Error>;
    /// The picture of this state to be drawn, if any.
    ///
    /// # Errors
    /// The error of the picture.
    fn picture(&mut self, moment: &Moment<'_>) -> Result<Option<Picture>, Error> {
        let _ = moment;
        Ok(None)
    }
    /// Receives the picture of this step.
    ///
    /// # Errors
    /// [`Error::Output`] when it cannot be written.
    fn drawn(&mut self, step: u64, image: Image) -> Result<(), Error> {
        let _ = (step, image);
        Ok(())
    }
    /// The tables to which it adds rows: a checkpoint stores their lengths.
    fn tables(&self) -> Vec<&Table> {
        Vec::new()
    }
    /// The end of the run: writes the remaining data.
    ///
    /// # Errors
    /// [`Error::Output`] when it cannot be written.
    fn finish(&mut self) -> Result<(), Error> {
        Ok(())
    }
}
