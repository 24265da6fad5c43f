//! Temperature, and energies per particle.

use glam::DVec3;

use super::series::number;
use super::{Measure, Moment, Row, Series, Times};
use crate::error::Error;
use crate::settings::{Key, Kind, Value};
use crate::state::State;

/// Whether the centre of mass takes part.
pub(super) const DRIFT: Key = Key::new(
    "drift",
    Kind::Flag,
    Value::Flag(false),
    "whether the motion of the centre of mass counts as heat; where it does not, there are as many degrees of freedom less as dimensions",
);

/// `thermo.csv`.
pub const MEASURE: Measure = Measure {
    name: "thermo",
    about: "temperature, and energies per particle, of all particles that are not fixed; rods, which take degrees of freedom, are not counted",
    keys: &[
        Key::new("boltzmann", Kind::Positive, Value::Number(1.0), "Boltzmann's constant k [mass length² / time² / temperature]"),
        DRIFT,
    ],
    cells: &[
        ("count", "active particles that are not fixed"),
        ("temperature", "T = 2 K / (f k), with f degrees of freedom"),
        ("kinetic", "½ Σ m v² per particle, relative to the centre of mass unless drift counts [mass length² / time²]"),
        ("potential", "the potential energy per particle [mass length² / time²]"),
        ("total", "both [mass length² / time²]"),
    ],
    times: Times::Chosen,
    usual: |_| Ok(None),
    begin: |setup, settings| {
        let held = setup.state.fixed();
        let (boltzmann, drift) = (settings.number("boltzmann"), settings.flag("drift"));
        Ok(Box::new(Thermo { held, boltzmann, drift, dimensions: setup.bounds.dimensions, ends: None }))
    },
};

/// The particles that move by forces, and the mean velocity of their mass.
pub(super) fn moving(state: &State, held: &[bool]) -> (Vec<usize>, DVec3) {
    let moves = |i: &usize| state.is_active(*i) && !held.get(*i).copied().unwrap_or(false) && state.mass()[*i] > 0.0;
    let all: Vec<usize> = (0..state.len()).filter(moves).collect();
    let mass: f64 = all.iter().map(|i| state.mass()[*i]).sum();
    let momentum: DVec3 = all.iter().map(|i| state.mass()[*i] * state.velocity()[*i]).sum();
    let mean = if mass > 0.0 { momentum / mass } else { DVec3::ZERO };
    (all, mean)
}

/// Temperatures of a run.
#[derive(Debug)]
pub struct Thermo {
    held: Vec<bool>,
    boltzmann: f64,
    drift: bool,
    dimensions: u32,
    ends: Option<[f64; 2]>,
}

impl Thermo {
    /// The first and the last temperature.
    #[must_use]
    pub fn ends(&self) -> Option<[f64; 2]> {
        self.ends
    }
    fn add(&mut self, temperature: f64) {
        self.ends = Some([self.ends.map_or(temperature, |[first, _]| first), temperature]);
    }
}

impl Series for Thermo {
    fn take(&mut self, moment: &Moment<'_>) -> Result<Vec<Row>, Error> {
        let (state, energies) = (moment.state, moment.state.energies()?);
        let (all, mean) = moving(state, &self.held);
        let mean = if self.drift { DVec3::ZERO } else { mean };
        let heat: f64 =
            all.iter().map(|i| 0.5 * state.mass()[*i] * (state.velocity()[*i] - mean).length_squared()).sum();
        let potential: f64 = all.iter().map(|i| energies[*i]).sum();
        let lost = usize::from(!self.drift);
        let degrees = f64::from(self.dimensions) * all.len().saturating_sub(lost) as f64;
        let temperature = if degrees > 0.0 { 2.0 * heat / (degrees * self.boltzmann) } else { 0.0 };
        self.add(temperature);
        let each = |sum: f64| sum / all.len().max(1) as f64;
        let numbers = [temperature, each(heat), each(potential), each(heat) + each(potential)];
        Ok(vec![std::iter::once((all.len() as u64).into()).chain(numbers.map(Into::into)).collect()])
    }
    fn recall(&mut self, _: u64, cells: &[&str]) {
        self.add(number(cells, 2));
    }
    fn summary(&self) -> Option<String> {
        self.ends.map(|[first, last]| format!("temperature {first:.4} → {last:.4}"))
    }
}
