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
    /// Its header: its name, with a number where the scene has several of a kind.
    title: String,
    /// Whether its settings are those of the scene, or follow from the forces.
    given: bool,
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
            let given: Vec<_> = chosen.iter().filter(|one| one.measure == measure).collect();
            for (number, one) in given.iter().enumerate() {
                let title =
                    if given.len() > 1 { format!("{} {}", measure.name, number + 1) } else { measure.name.to_owned() };
                all.extend(Plotted::new(measure, one.settings.clone(), setup).map(|one| Plotted {
                    title,
                    given: true,
                    ..one
                }));
            }
            if given.is_empty() {
                // A measure may have no use in this run; of a table with several rows there is no plot.
                all.extend(usual(measure, setup)?.and_then(|settings| Plotted::new(measure, settings, setup)));
            }
        }
        Ok(Self { all, times: Seldom::default() })
    }
    /// The same, which begins again.
    pub fn restarted(&mut self, setup: &Setup) {
        for one in &mut self.all {
            // It was there at the start.
            let usual = if one.given { None } else { usual(one.measure, setup).ok().flatten() };
            one.restarted(usual.unwrap_or_else(|| one.settings.clone()), setup);
        }
        self.times = Seldom::default();
    }
    /// Goes on with forces that were changed: measures with settings that follow from forces begin again where these differ.
    ///
    /// # Errors
    /// When a measure that a run takes by default cannot be taken.
    pub fn follow(&mut self, setup: &Setup) -> Result<(), Error> {
        for one in &mut self.all {
            let settings = if one.given { None } else { usual(one.measure, setup)? };
            match settings.filter(|settings| *settings != one.settings) {
                Some(settings) => one.restarted(settings, setup),
                None => one.series.follow(setup)?,
            }
        }
        Ok(())
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
    /// Shows those that are looked at, and a header of each. Returns whether there are others among them than before.
    pub fn show(&mut self, ui: &mut Ui) -> bool {
        let before: Vec<bool> = self.all.iter().map(|one| one.open).collect();
        self.close();
        CollapsingHeader::new("Measures").default_open(false).show(ui, |ui| {
            for one in &mut self.all {
                let title = CollapsingHeader::new(&one.title).default_open(one.measure.name == "energy");
                let response = title.show(ui, |ui| one.show(ui));
                response.header_response.on_hover_text(one.measure.about);
                one.open = response.body_returned.is_some();
            }
        });
        self.all.iter().zip(before).any(|(one, before)| one.open && !before)
    }
}

/// The settings of a measure that a scene does not name: as a run takes it, or its defaults.
fn usual(measure: &Measure, setup: &Setup) -> Result<Option<Settings>, Error> {
    let defaults = || Some(Settings::defaults(measure.keys)).filter(|all| all.fault(measure.keys).is_none());
    Ok((measure.usual)(setup)?.or_else(defaults))
}

impl Plotted {
    fn new(measure: &'static Measure, settings: Settings, setup: &Setup) -> Option<Self> {
        let series = (measure.begin)(setup, &settings).ok().filter(|series| series.needs() == Needs::default())?;
        // Of energies the parts and their sum, of others the first.
        let many = if measure.name == "energy" { 3 } else { 1 };
        let shown = (0..measure.cells.len()).map(|cell| cell < many).collect();
        let (first, rows) = (Vec::new(), VecDeque::new());
        let title = measure.name.to_owned();
        Some(Self { measure, title, given: false, settings, series, shown, first, rows, open: false, fault: None })
    }
    fn restarted(&mut self, settings: Settings, setup: &Setup) {
        if let Some(anew) = Self::new(self.measure, settings, setup) {
            self.settings = anew.settings;
            self.series = anew.series;
            (self.first, self.rows, self.fault) = (anew.first, anew.rows, anew.fault);
        }
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
                // A state that is measured again after a force was changed.
                self.rows.pop_back_if(|(time, _)| *time >= moment.state.time);
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
        Grid::new(&self.title).num_columns(3).striped(true).show(ui, |ui| {
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
        Plot::new((&self.title, "plot")).height(150.0).legend(Legend::default()).allow_scroll(false).show(ui, |plot| {
            for (place, ((name, _), _)) in cells {
                let points = self.rows.iter().filter_map(|(time, row)| Some([*time, *row.get(place)?]));
                let points: Vec<_> = points.filter(|[_, value]| value.is_finite()).collect();
                plot.line(Line::new(*name, points));
            }
        });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Array;
    use crate::measure::Energy;
    use crate::scene::{Options, Scene, Source};

    /// A block of a flock with its measures, and its state with potential energies.
    fn watched(more: &str) -> (Setup, Plots, State) {
        let text = format!(
            "[simulation]\ndt = 0.01\nsteps = 10\n[[particles]]\nshape = \"block\"\nspacing = 0.3\nsize = [1.2, 1.2, 1.2]\n\
             velocity = [1, 0, 0]\n[[force]]\nkind = \"boids\"\nrange = 0.5\nseparation_range = 0.2\nmax_speed = 2\n{more}"
        );
        of(text)
    }
    fn of(text: String) -> (Setup, Plots, State) {
        let source = Source::Memory { name: "scene.toml".to_owned(), text, files: Vec::new() };
        let mut scene = Scene::load(&source, &[], &Options::default()).unwrap_or_else(|faults| panic!("{faults}"));
        let setup = scene.setup();
        let plots = Plots::new(&setup, &scene.measures).expect("measures");
        let mut state = setup.state.clone();
        let columns = setup.columns().expect("columns");
        state.declare(columns.get("potential").expect("potential energies")).expect("a column");
        let potential = (0..state.len()).map(|row| row as f64).collect();
        state.set("potential", Array::Float(potential)).expect("potential energies");
        (setup, plots, state)
    }
    fn named<'a>(plots: &'a mut Plots, title: &str) -> &'a mut Plotted {
        plots.all.iter_mut().find(|one| one.title == title).unwrap_or_else(|| panic!("no {title}"))
    }

    #[test]
    fn what_is_looked_at_is_measured_and_nothing_else() {
        let (_, mut plots, mut state) = watched("");
        named(&mut plots, "flock").open = true;
        for time in [0.0, 0.5, 2.0] {
            state.time = time;
            state.velocity_mut().iter_mut().for_each(|v| v.y += time);
            plots.take(&Arc::new(state.clone()));
            let (measured, row) = named(&mut plots, "energy").rows.back().cloned().expect("a row");
            let energy = Energy::of(&state).expect("energies");
            assert!(energy.kinetic > 0.0 && energy.potential > 0.0);
            assert!((measured - time).abs() < 1e-12);
            assert_eq!(row[..3], [energy.kinetic, energy.potential, energy.kinetic + energy.potential]);
        }
        for one in &plots.all {
            let expected = if ["energy", "flock"].contains(&one.title.as_str()) { 3 } else { 0 };
            assert_eq!(one.rows.len(), expected, "{}: {:?}", one.title, one.fault);
        }
    }
    #[test]
    fn measures_of_one_kind_are_shown_apart() {
        let two = "[[measure]]\nkind = \"flock\"\nrange = 0.35\n[[measure]]\nkind = \"flock\"\nrange = 0.1\n";
        let (_, mut plots, state) = watched(two);
        plots.all.iter_mut().for_each(|one| one.open = true);
        plots.take(&Arc::new(state));
        let place = MEASURES.iter().find(|one| one.name == "flock").expect("flock").cells;
        let place = place.iter().position(|(name, _)| *name == "clusters").expect("clusters");
        let mut clusters = |title| named(&mut plots, title).rows[0].1[place];
        let (near, alone) = (clusters("flock 1"), clusters("flock 2"));
        assert_eq!((near, alone), (1.0, 64.0));
    }
    #[test]
    fn corrections_beyond_a_cut_off_are_those_of_the_present_law() {
        let text = "[simulation]\ndt = 0.001\nsteps = 10\n[box]\nlow = [0, 0, 0]\nsize = [9, 9, 9]\nboundary = \"periodic\"\n[[particles]]\n\
                    shape = \"block\"\nspacing = 1.5\nsize = [9, 9, 9]\ncenter = [4.5, 4.5, 4.5]\n[[force]]\nkind = \"lennard_jones\"\n\
                    range = 3\ntruncation = \"cut\"\n";
        let (setup, mut plots, state) = of(text.to_owned());
        let state = Arc::new(state);
        let energy = |plots: &mut Plots| {
            named(plots, "tail").open = true;
            plots.take(&state);
            named(plots, "tail").rows.back().expect("a row").1[0]
        };
        let before = energy(&mut plots);
        let mut forces = setup.forces.clone();
        forces[0] = forces[0].changed("epsilon", &2.0.into()).expect("an energy");
        plots.follow(&Setup { forces, ..setup }).expect("a law");
        let after = energy(&mut plots);
        assert!(before < 0.0 && (after / before - 2.0).abs() < 1e-9, "{before} {after}");
        assert_eq!(named(&mut plots, "tail").rows.len(), 1, "one row of one time");
    }
    #[test]
    fn the_usual_range_is_that_of_the_force_as_it_is() {
        for (more, follows) in [("", true), ("[[measure]]\nkind = \"flock\"\nrange = 0.5\n", false)] {
            let (setup, mut plots, state) = watched(more);
            named(&mut plots, "flock").open = true;
            plots.take(&Arc::new(state));
            plots.follow(&setup).expect("the same");
            assert_eq!(named(&mut plots, "flock").rows.len(), 1, "nothing was changed");
            let mut forces = setup.forces.clone();
            forces[0] = forces[0].changed("range", &0.25.into()).expect("a range");
            plots.follow(&Setup { forces, ..setup.clone() }).expect("a range");
            let flock = named(&mut plots, "flock");
            let (range, rows) = if follows { (0.25, 0) } else { (0.5, 1) };
            assert_eq!((flock.settings.number("range"), flock.rows.len()), (range, rows));
            // Back to the forces of the scene.
            plots.restarted(&setup);
            assert_eq!(named(&mut plots, "flock").settings.number("range").to_bits(), 0.5_f64.to_bits());
        }
    }
}
