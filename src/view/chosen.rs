//! A particle that was chosen: its columns, and the past of one of them.

use std::collections::VecDeque;

use egui::Ui;
use egui_plot::{Line, Plot};
use glam::DVec3;

use super::action::Action;
use super::controls::digits;
use super::seldom::Seldom;
use crate::error::Error;
use crate::kernel::{Array, Backend, Column, ID, Kind, POSITION, Shape};
use crate::simulation::Simulation;

/// Values that are kept of what is plotted.
const KEPT: usize = 1024;

/// One value of the particle.
struct Row {
    column: String,
    /// What it is, and its unit.
    about: String,
    text: String,
    /// The value, or the length of a vector.
    size: f64,
}

/// A chosen particle.
pub struct Chosen {
    pub id: u32,
    /// Where its values lie in the columns.
    place: usize,
    /// Where it is; nothing where it has no place, such as one that is not born.
    pub position: Option<DVec3>,
    /// Whether the camera goes with it.
    pub follow: bool,
    rows: Vec<Row>,
    times: Seldom,
    /// The time of what was read.
    seen: f64,
    /// The column that is plotted, with the times and values.
    plotted: Option<String>,
    past: VecDeque<[f64; 2]>,
}

impl Chosen {
    /// The particle whose values lie at a place of the columns.
    pub async fn at<B: Backend>(simulation: &mut Simulation<B>, place: usize) -> Result<Option<Self>, Error> {
        let ids = ids(simulation).await?;
        let Some(id) = ids.get(place).copied() else { return Ok(None) };
        let (rows, times, past) = (Vec::new(), Seldom::default(), VecDeque::new());
        let seen = f64::NEG_INFINITY;
        let mut chosen = Self { id, place, position: None, follow: false, rows, times, seen, plotted: None, past };
        chosen.look(simulation, f64::NEG_INFINITY).await?;
        Ok(Some(chosen))
    }
    /// Finds it again, whatever has moved; false where it has left. What a run that stands still shows of it is of its present state.
    pub async fn update<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        time: f64,
        rests: bool,
    ) -> Result<bool, Error> {
        #[expect(clippy::float_cmp, reason = "the same time, and no other")]
        let known = self.seen == time;
        if rests && known {
            return Ok(true);
        }
        let ids = ids(simulation).await?;
        if ids.get(self.place) != Some(&self.id) {
            let Some(place) = ids.iter().position(|id| *id == self.id) else { return Ok(false) };
            self.place = place;
        }
        if self.times.is_due() || rests {
            self.look(simulation, time).await?;
            self.times.done();
        } else {
            self.position = vector(&simulation.read_column(POSITION.name).await?, self.place);
        }
        Ok(true)
    }
    /// Reads all its columns.
    async fn look<B: Backend>(&mut self, simulation: &mut Simulation<B>, time: f64) -> Result<(), Error> {
        let columns: Vec<Column> =
            simulation.columns().iter().filter(|column| column.shape == Shape::Particle).cloned().collect();
        self.rows.clear();
        self.seen = time;
        for column in &columns {
            // What nothing computes has no values.
            let Ok(values) = simulation.read_column(&column.name).await else { continue };
            if column.name == POSITION.name {
                self.position = vector(&values, self.place);
            }
            self.rows.extend(row(column, &values, self.place));
        }
        let value = self.plotted.as_ref().and_then(|name| self.rows.iter().find(|row| row.column == *name));
        if let Some(row) = value
            && self.past.back().is_none_or(|[last, _]| *last < time)
        {
            if self.past.len() == KEPT {
                self.past.pop_front();
            }
            self.past.push_back([time, row.size]);
        }
        Ok(())
    }
    /// Plots a column from now on, or none.
    pub fn plot(&mut self, column: String) {
        self.past.clear();
        self.plotted = if self.plotted.as_ref() == Some(&column) { None } else { Some(column) };
    }
    /// The run begins again.
    pub fn restarted(&mut self) {
        self.past.clear();
        (self.times, self.seen) = (Seldom::default(), f64::NEG_INFINITY);
    }
    /// Its columns.
    pub fn show(&self, ui: &mut Ui, actions: &mut Vec<Action>) {
        ui.horizontal(|ui| {
            let mut follow = self.follow;
            if ui.checkbox(&mut follow, "follow").on_hover_text("the camera goes with it: T").changed() {
                actions.push(Action::Follow);
            }
            if ui.button("Let go").on_hover_text("Esc").clicked() {
                actions.push(Action::LetGo);
            }
        });
        egui::Grid::new("columns").num_columns(2).striped(true).show(ui, |ui| {
            for row in &self.rows {
                let plotted = self.plotted.as_deref() == Some(&row.column);
                let about = format!("{}\na click plots it", row.about);
                if ui.selectable_label(plotted, &row.column).on_hover_text(about).clicked() {
                    actions.push(Action::Plot(row.column.clone()));
                }
                ui.monospace(&row.text);
                ui.end_row();
            }
        });
        let Some(name) = &self.plotted else { return };
        Plot::new("past").height(120.0).allow_scroll(false).show(ui, |plot| {
            plot.line(Line::new(name.clone(), self.past.iter().copied().collect::<Vec<_>>()));
        });
    }
}

async fn ids<B: Backend>(simulation: &mut Simulation<B>) -> Result<Vec<u32>, Error> {
    match simulation.read_column(ID.name).await? {
        Array::Uint(ids) => Ok(ids),
        _ => Ok(Vec::new()),
    }
}

fn vector(values: &Array, place: usize) -> Option<DVec3> {
    match values {
        Array::Vec4(values) => values.get(place).map(|x| x.truncate()),
        Array::Vec3(values) => values.get(place).copied(),
        Array::Float(_) | Array::Uint(_) => None,
    }
}

fn row(column: &Column, values: &Array, place: usize) -> Option<Row> {
    let list = |parts: &[f64]| parts.iter().map(|x| digits(*x)).collect::<Vec<_>>().join("  ");
    let (text, size) = match (values, column.kind) {
        (Array::Vec4(values), Kind::Quaternion) => {
            let q = values.get(place)?;
            (list(&q.to_array()), q.length())
        }
        (Array::Vec4(_) | Array::Vec3(_), _) => {
            let v = vector(values, place)?;
            (list(&v.to_array()), v.length())
        }
        (Array::Float(values), _) => values.get(place).map(|x| (digits(*x), *x))?,
        (Array::Uint(values), _) => values.get(place).map(|n| (n.to_string(), f64::from(*n)))?,
    };
    Some(Row { column: column.name.to_string(), about: column.with_unit(&column.about), text, size })
}
