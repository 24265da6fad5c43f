//! Measures of the recent past: those of the scene, those that a run of it takes, and those that need no settings.

use std::collections::VecDeque;
use std::sync::Arc;

use egui::{CollapsingHeader, Grid, Ui};
use egui_plot::{Legend, Line, Plot};

use super::controls::digits;
use super::seldom::Seldom;
use crate::error::Error;
use crate::measure::{Cell, MEASURES, Measure, Moment, Needs, Series};
use crate::scene::Chosen;
use crate::settings::Settings;
use crate::simulation::Setup;
use crate::state::State;

/// Rows that are kept.
const KEPT: usize = 1024;

/// A measure, its rows, and which of its cells are plotted.
struct Plotted {
    measure: &'static Measure,
    settings: Settings,
    series: Box<dyn Series>,
    shown: Vec<bool>,
    first: Vec<f64>,
    rows: VecDeque<(f64, Vec<f64>)>,
    /// Whether it is looked at: others are not taken.
    open: bool,
    fault: Option<String>,
}

/// The measures of a run that is watched.
pub struct Plots {
    all: Vec<Plotted>,
    times: Seldom,
}

impl Plots {
    /// Those of a setup, and of its scene.
    ///
    /// # Errors
    /// When a measure that a run takes by default cannot be taken.
    pub fn new(setup: &Setup, chosen: &[Chosen]) -> Result<Self, Error> {
        let mut all = Vec::new();
        for measure in MEASURES {
            let given = chosen.iter().find(|one| one.measure == measure).map(|one| one.settings.clone());
            let defaults = Some(Settings::defaults(measure.keys)).filter(|all| all.fault(measure.keys).is_none());
            let Some(settings) = given.or((measure.usual)(setup)?).or(defaults) else { continue };
            // A measure may have no use in this run; of a table with several rows there is no plot.
            all.extend(Plotted::new(measure, settings, setup));
        }
        Ok(Self { all, times: Seldom::default() })
    }
    /// The same, which begins again.
    pub fn restarted(&mut self, setup: &Setup) {
        for one in &mut self.all {
            if let Some(anew) = Plotted::new(one.measure, one.settings.clone(), setup) {
                *one = Plotted { shown: std::mem::take(&mut one.shown), open: one.open, ..anew };
            }
        }
        self.times = Seldom::default();
    }
    /// Whether it is time for the next rows.
    pub fn is_due(&mut self) -> bool {
        self.times.is_due()
    }
    /// Measures a state, which was read since it was due.
    pub fn take(&mut self, state: &Arc<State>) {
        let moment = Moment { state, density: &[], clock: None, links: None, virial: None };
        // Energies cost little, and are known from the start.
        self.all.iter_mut().filter(|one| one.open || one.measure.name == "energy").for_each(|one| one.take(&moment));
    }
    /// All that is done with the state was done.
    pub fn done(&mut self) {
        self.times.done();
    }
    /// Nothing of them is seen.
    pub fn close(&mut self) {
        self.all.iter_mut().for_each(|one| one.open = false);
    }
    /// Shows those that are looked at, and a header of each.
    pub fn show(&mut self, ui: &mut Ui) {
        self.close();
        CollapsingHeader::new("Measures").default_open(false).show(ui, |ui| {
            for one in &mut self.all {
                let title = CollapsingHeader::new(one.measure.name).default_open(one.measure.name == "energy");
                let response = title.show(ui, |ui| one.show(ui));
                response.header_response.on_hover_text(one.measure.about);
                one.open = response.body_returned.is_some();
            }
        });
    }
}

impl Plotted {
    fn new(measure: &'static Measure, settings: Settings, setup: &Setup) -> Option<Self> {
        let series = (measure.begin)(setup, &settings).ok().filter(|series| series.needs() == Needs::default())?;
        // Of energies the parts and their sum, of others the first.
        let many = if measure.name == "energy" { 3 } else { 1 };
        let shown = (0..measure.cells.len()).map(|cell| cell < many).collect();
        let (first, rows) = (Vec::new(), VecDeque::new());
        Some(Self { measure, settings, series, shown, first, rows, open: false, fault: None })
    }
    fn take(&mut self, moment: &Moment<'_>) {
        let numbers = |row: &Vec<Cell>| -> Vec<f64> {
            row.iter()
                .map(|cell| match cell {
                    Cell::Number(x) => *x,
                    #[expect(clippy::cast_precision_loss, reason = "a plot")]
                    Cell::Whole(n) => *n as f64,
                    Cell::Word(_) | Cell::Empty => f64::NAN,
                })
                .collect()
        };
        match self.series.take(moment).as_deref() {
            Ok([row]) => {
                let row = numbers(row);
                self.first.resize(row.len(), f64::NAN);
                for (first, now) in self.first.iter_mut().zip(&row).filter(|(first, _)| !first.is_finite()) {
                    *first = *now;
                }
                if self.rows.len() == KEPT {
                    self.rows.pop_front();
                }
                self.rows.push_back((moment.state.time, row));
                self.fault = None;
            }
            Ok([]) => (),
            Ok(_) => {
                self.fault = Some(format!("its table has several rows: `motes run` writes {}.csv", self.measure.name));
            }
            Err(why) => self.fault = Some(why.to_string()),
        }
    }
    fn show(&mut self, ui: &mut Ui) {
        if let Some(fault) = &self.fault {
            ui.weak(fault);
            return;
        }
        let Some((_, last)) = self.rows.back() else {
            ui.weak("nothing is measured yet");
            return;
        };
        Grid::new(self.measure.name).num_columns(3).striped(true).show(ui, |ui| {
            for (place, (name, about)) in self.measure.cells.iter().enumerate() {
                let (Some(now), Some(first), Some(shown)) =
                    (last.get(place), self.first.get(place), self.shown.get_mut(place))
                else {
                    continue;
                };
                let about = format!("{about}\na click plots it");
                if ui.selectable_label(*shown, *name).on_hover_text(about).clicked() {
                    *shown = !*shown;
                }
                if now.is_finite() {
                    ui.monospace(digits(*now));
                    ui.monospace(format!("{:+.1e}", now - first))
                        .on_hover_text("its change since it was first measured");
                }
                ui.end_row();
            }
        });
        let cells = self.measure.cells.iter().zip(&self.shown).enumerate().filter(|(_, (_, shown))| **shown);
        Plot::new((self.measure.name, "plot")).height(150.0).legend(Legend::default()).allow_scroll(false).show(
            ui,
            |plot| {
                for (place, ((name, _), _)) in cells {
                    let points = self.rows.iter().filter_map(|(time, row)| Some([*time, *row.get(place)?]));
                    let points: Vec<_> = points.filter(|[_, value]| value.is_finite()).collect();
                    plot.line(Line::new(*name, points));
                }
            },
        );
    }
}
