//! `population.csv`: counts of pending, active and removed particles.

use std::sync::Arc;

use super::table::{Lengths, Table};
use super::writer::{Moment, Writer};
use crate::error::Error;
use crate::formats::Folder;
use crate::life::Population;

const NAME: &str = "population.csv";
const HEADER: &str = "step,time,pending,active,removed,spawned,mass";

/// The last count, and the table.
#[derive(Debug, Default)]
pub struct Counts {
    folder: Option<Arc<Folder>>,
    table: Option<Table>,
    last: Option<Population>,
}

impl Counts {
    /// The last count, where particles are spawned or removed.
    #[must_use]
    pub fn last(&self) -> Option<Population> {
        self.last
    }
}

impl Writer for Counts {
    fn open(&mut self, folder: &Arc<Folder>, past: &Lengths) -> Result<(), Error> {
        if past.contains_key(NAME) {
            self.table = Some(Table::open(folder, NAME, HEADER, past)?.0);
        }
        self.folder = Some(folder.clone());
        Ok(())
    }
    fn take(&mut self, moment: &Moment<'_>) -> Result<(), Error> {
        let state = moment.state;
        if let (None, false, Some(folder)) = (&self.table, state.life().is_empty(), &self.folder) {
            self.table = Some(Table::open(folder, NAME, HEADER, &Lengths::new())?.0);
        }
        let Some(table) = &mut self.table else { return Ok(()) };
        let of = state.population();
        let spawned = (of.active + of.removed) as f64;
        let mass = state.mass().iter().sum::<f64>();
        self.last = Some(of);
        table.row(state.step, &[state.time, of.pending as f64, of.active as f64, of.removed as f64, spawned, mass])
    }
    fn tables(&self) -> Vec<&Table> {
        self.table.iter().collect()
    }
}
