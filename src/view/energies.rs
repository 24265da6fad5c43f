//! The energies of the recent past.

use std::collections::VecDeque;

use egui::Ui;
use egui_plot::{Legend, Line, Plot};

use super::controls::digits;
use super::seldom::Seldom;
use crate::error::Error;
use crate::measure::Energy;
use crate::state::State;

/// Measurements that are kept.
const KEPT: usize = 1024;

/// Measured energies.
#[derive(Default)]
pub struct Energies {
    rows: VecDeque<Energy>,
    first: Option<Energy>,
    times: Seldom,
}

impl Energies {
    /// Whether it is time for the next one.
    pub fn is_due(&mut self) -> bool {
        self.times.is_due()
    }
    /// Measures a state, which was read since it was due.
    pub fn take(&mut self, snapshot: &State) -> Result<(), Error> {
        let row = Energy::of(snapshot)?;
        self.first.get_or_insert(row);
        if self.rows.len() == KEPT {
            self.rows.pop_front();
        }
        self.rows.push_back(row);
        Ok(())
    }
    /// All that is done with the state was done.
    pub fn done(&mut self) {
        self.times.done();
    }
    /// Plots them.
    pub fn show(&self, ui: &mut Ui) {
        let (Some(first), Some(last)) = (self.first, self.rows.back()) else {
            ui.weak("nothing is measured yet");
            return;
        };
        let line = |name: &str, of: fn(&Energy) -> f64| {
            Line::new(name.to_owned(), self.rows.iter().map(|row| [row.time, of(row)]).collect::<Vec<_>>())
        };
        Plot::new("energies").height(150.0).legend(Legend::default()).allow_scroll(false).show(ui, |plot| {
            plot.line(line("kinetic", |row| row.kinetic));
            plot.line(line("potential", |row| row.potential));
            plot.line(line("total", Energy::total));
        });
        let change = last.total() - first.total();
        let scale = first.kinetic.abs().max(first.potential.abs());
        let part = if scale > 0.0 {
            format!(", {:+.1e} of the larger part at the start", change / scale)
        } else {
            String::new()
        };
        ui.label(format!("total {}, changed by {}{part}", digits(last.total()), digits(change)));
    }
}
