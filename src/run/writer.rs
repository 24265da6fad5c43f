//! Writers, which receive the states of a run.

use std::sync::Arc;

use super::table::{Lengths, Table};
use crate::error::Error;
use crate::formats::Folder;
use crate::links::Links;
use crate::render::{Image, Picture};
use crate::simulation::Clock;
use crate::state::State;

/// The state of an output, and what is known beside it.
#[derive(Debug, Clone, Copy)]
pub struct Moment<'a> {
    /// The state, which a writer that works on a thread of its own shares.
    pub state: &'a Arc<State>,
    /// The densities of a fluid, by id; none where nothing flows.
    pub density: &'a [f32],
    /// The clock, where steps are adaptive.
    pub clock: Option<&'a Clock>,
    /// What is left of links, where they may break.
    pub links: Option<&'a Links>,
}

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
    /// Whether it needs the column `potential`, which costs an evaluation and is in no file of particles.
    fn measures(&self) -> bool {
        false
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
