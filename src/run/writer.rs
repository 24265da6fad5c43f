//! Writers, which receive the states of a run.

use std::sync::Arc;

use super::Folder;
use super::table::{Lengths, Table};
use crate::error::Error;
use crate::measure::Moment;
use crate::render::{Image, Picture};

/// Takes the state of every output of a run: writes a table, a file of particles, a picture, or shows it elsewhere.
pub trait Writer: Send + Sync {
    /// Opens its files in the folder of the run. Where the run continues, `past` has the lengths of its tables.
    ///
    /// # Errors
    /// [`Error::Output`] when a file cannot be made.
    fn open(&mut self, folder: &Arc<Folder>, past: &Lengths) -> Result<(), Error> {
        let _ = (folder, past);
        Ok(())
    }
    /// Takes a state.
    ///
    /// # Errors
    /// [`Error::Output`] when it cannot be written, or what else it finds wrong.
    fn take(&mut self, moment: &Moment<'_>) -> Result<(), Error>;
    /// The picture of this state that is to be drawn, if it wants one.
    ///
    /// # Errors
    /// What is wrong with the picture.
    fn picture(&mut self, moment: &Moment<'_>) -> Result<Option<Picture>, Error> {
        let _ = moment;
        Ok(None)
    }
    /// Takes the picture that it wanted of this step.
    ///
    /// # Errors
    /// [`Error::Output`] when it cannot be written.
    fn drawn(&mut self, step: u64, image: Image) -> Result<(), Error> {
        let _ = (step, image);
        Ok(())
    }
    /// The tables to which it adds rows: a checkpoint quotes their lengths.
    fn tables(&self) -> Vec<&Table> {
        Vec::new()
    }
    /// The run is over: writes what is left.
    ///
    /// # Errors
    /// [`Error::Output`] when it cannot be written.
    fn finish(&mut self) -> Result<(), Error> {
        Ok(())
    }
}
