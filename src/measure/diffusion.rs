//! Mean squared displacement and velocity autocorrelation.

use std::borrow::Cow;

use glam::DVec3;

use super::series::number;
use super::{Measure, Moment, Row, Series, Times};
use crate::error::Error;
use crate::kernel::Kind as Element;
use crate::settings::{Key, Kind, Value};

/// The column that it reads.
const UNWRAPPED: &str = "unwrapped";

/// `diffusion.csv`.
pub const MEASURE: Measure = Measure {
    name: "diffusion",
    about: "how far particles have gone since the start, through the sides of a periodic box too, and how much of their velocities is left (Allen & Tildesley 2017, 8.5)",
    keys: &[Key::new("species", Kind::Species, Value::Text(Cow::Borrowed("all")), "the species that is measured, or \"all\"")],
    cells: &[
        ("msd", "⟨|x(t) − x(0)|²⟩, of the column `unwrapped` [length²]"),
        ("msd_x", "its part along x [length²]"),
        ("msd_y", "along y"),
        ("msd_z", "along z"),
        ("vacf", "⟨v(0) · v(t)⟩ [length² / time²]"),
        ("diffusion", "msd / 2 d t in d dimensions, which is the coefficient of diffusion for long times; empty at the start [length² / time]"),
    ],
    times: Times::Chosen,
    usual: |_| Ok(None),
    begin: |setup, settings| {
        let state = &setup.state;
        if setup.has_inactive() {
            return Err(Error::Scene(
                "the measure `diffusion` follows particles from the start to the end: leave out emitters, drains and mergers, or the measure".to_owned(),
            ));
        }
        let columns = setup.columns()?;
        let is_unwrapped = |column: &crate::kernel::Column| {
            column.kind == Element::Vector && column.rate.as_ref().is_some_and(|rate| rate == "velocity")
        };
        if !columns.get(UNWRAPPED).is_some_and(is_unwrapped) {
            return Err(Error::Scene(
                "the measure `diffusion` reads displacements that no side of a box interrupts: add [[column]] with name = \"unwrapped\", \
                 kind = \"vector\", rate = \"velocity\" and initial = [0, 0, 0]"
                    .to_owned(),
            ));
        }
        let species = settings.species("species");
        let fixed = state.fixed();
        let is_of = |i: &usize| !fixed[*i] && species.is_none_or(|species| state.species()[*i] == species);
        let chosen: Vec<usize> = (0..state.len()).filter(is_of).collect();
        if chosen.is_empty() {
            let why = "`diffusion` measures a species of which no particle moves: choose another, or \"all\"".to_owned();
            return Err(Error::Setting { key: "species", why });
        }
        let from = state.vector(UNWRAPPED).map_or_else(|| vec![DVec3::ZERO; state.len()], <[DVec3]>::to_vec);
        let (velocities, time) = (state.velocity().to_vec(), state.time);
        Ok(Box::new(Diffusion { chosen, from, velocities, time, dimensions: setup.bounds.dimensions, last: None }))
    },
};

/// Displacements of a run.
#[derive(Debug)]
pub struct Diffusion {
    chosen: Vec<usize>,
    from: Vec<DVec3>,
    velocities: Vec<DVec3>,
    time: f64,
    dimensions: u32,
    last: Option<f64>,
}

impl Diffusion {
    /// The mean squared displacement of the last row \[length²\].
    #[must_use]
    pub fn last(&self) -> Option<f64> {
        self.last
    }
}

impl Series for Diffusion {
    fn take(&mut self, moment: &Moment<'_>) -> Result<Vec<Row>, Error> {
        let state = moment.state;
        let (Some(now), true) = (state.vector(UNWRAPPED), state.len() == self.from.len()) else {
            return Err(Error::Scene("the measure `diffusion` needs the column `unwrapped` of all particles".to_owned()));
        };
        let count = self.chosen.len() as f64;
        let (mut squares, mut left) = (DVec3::ZERO, 0.0);
        for i in &self.chosen {
            let way = now[*i] - self.from[*i];
            squares += way * way / count;
            left += self.velocities[*i].dot(state.velocity()[*i]) / count;
        }
        let (msd, elapsed) = (squares.element_sum(), state.time - self.time);
        self.last = Some(msd);
        let coefficient =
            if elapsed > 0.0 { (msd / (2.0 * f64::from(self.dimensions) * elapsed)).into() } else { super::Cell::Empty };
        let numbers = [msd, squares.x, squares.y, squares.z, left].map(Into::into);
        Ok(vec![numbers.into_iter().chain([coefficient]).collect()])
    }
    fn recall(&mut self, _: u64, cells: &[&str]) {
        self.last = Some(number(cells, 1));
    }
    fn summary(&self) -> Option<String> {
        self.last.map(|msd| format!("mean squared displacement {msd:.4}"))
    }
}
