//! `NAME.csv`: the rows of a measure.

use std::fmt::Write as _;
use std::sync::Arc;

use super::Folder;
use super::table::{Lengths, Table};
use crate::error::Error;
use crate::measure::{MEASURES, Measure, Moment, Series};
use crate::scene::Chosen;
use crate::simulation::Setup;

/// A measure in the course of a run, with its table.
#[derive(Debug)]
pub struct Measured {
    /// The measure.
    pub measure: &'static Measure,
    /// The results so far.
    pub series: Box<dyn Series>,
    /// The name of its table.
    file: String,
    /// Steps of dt from one row to the next; `None`: one for each output.
    every: Option<u64>,
    /// Whether it is taken after each step.
    pub(super) each_step: bool,
    table: Option<Table>,
    /// The step of its last row.
    last: Option<u64>,
}

impl Measured {
    /// The measures that a scene chooses, and the default ones of such a run, in the order of the register.
    ///
    /// # Errors
    /// The fault of a measure in such a run.
    pub(super) fn all(chosen: &[Chosen], setup: &Setup) -> Result<Vec<Self>, Error> {
        let mut all = Vec::new();
        for measure in MEASURES {
            let mut own: Vec<_> = chosen.iter().filter(|one| one.measure == measure).cloned().collect();
            if own.is_empty() {
                own.extend((measure.usual)(setup)?.map(|settings| Chosen { measure, settings, every: None }));
            }
            for (one, number) in own.into_iter().zip(1..) {
                let file = if number == 1 {
                    format!("{}.csv", measure.name)
                } else {
                    format!("{}_{number}.csv", measure.name)
                };
                let (series, every) = ((measure.begin)(setup, &one.settings)?, one.every);
                all.push(Self { measure, series, file, every, each_step: false, table: None, last: None });
            }
        }
        Ok(all)
    }
    /// The name of its table.
    #[must_use]
    pub fn file(&self) -> &str {
        &self.file
    }
    /// The step of dt of its next row, where its rows are independent of outputs.
    pub(super) fn next(&self, done: u64) -> u64 {
        self.every.map_or(u64::MAX, |every| (done / every + 1).saturating_mul(every))
    }
    /// Whether it is taken after `done` steps of dt, or at this output.
    pub(super) fn is_due(&self, done: u64, is_output: bool) -> bool {
        self.each_step || self.every.map_or(is_output, |every| done.is_multiple_of(every))
    }
    /// Opens its table. Where the run continues, it is truncated to the length in the checkpoint, and the remaining rows are read.
    pub(super) fn open(&mut self, folder: &Arc<Folder>, past: &Lengths) -> Result<(), Error> {
        let (table, rows) = Table::open(folder, &self.file, &self.measure.header(), past)?;
        for cells in rows.iter() {
            if let [step, cells @ ..] = &cells[..] {
                self.series.recall(step.parse().unwrap_or_default(), cells);
            }
        }
        self.table = Some(table);
        Ok(())
    }
    /// Measures a state.
    pub(super) fn take(&mut self, moment: &Moment<'_>) -> Result<(), Error> {
        // A run that is stopped measures its last state, which may have been measured already.
        if self.last.replace(moment.state.step) == Some(moment.state.step) {
            return Ok(());
        }
        for row in self.series.take(moment)? {
            let mut text = format!("{:?}", moment.state.time);
            // Writing to a String cannot fail.
            row.iter().for_each(|cell| {
                let _ = write!(text, ",{cell}");
            });
            if let Some(table) = &mut self.table {
                table.words(moment.state.step, &text)?;
            }
        }
        Ok(())
    }
    /// Its table.
    pub(super) fn table(&self) -> Option<&Table> {
        self.table.as_ref()
    }
}
