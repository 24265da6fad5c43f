//! The heat capacity at constant volume C, from fluctuations of N particles with f degrees of freedom:
//!   at constant energy  ⟨δK²⟩ / ⟨K⟩² = (2 / f) (1 − f k / 2 C)   (Lebowitz, Percus & Verlet, Phys. Rev. 153, 250, 1967);
//!   in a heat bath      C = ⟨δE²⟩ / k T²                        (Allen & Tildesley 2017, 2.5).
//! The error is that of the mean of the squares, by block averages (Flyvbjerg & Petersen 1989).

use super::blocks;
use super::series::number;
use super::thermo::{DRIFT, moving};
use super::{Cell, Measure, Moment, Row, Series, Times};
use crate::error::Error;
use crate::forces::Component;
use crate::motion::Hold;
use crate::settings::{Key, Kind, Value};
use crate::simulation::Setup;

/// `heat_capacity.csv`.
pub const MEASURE: Measure = Measure {
    name: "heat_capacity",
    about: "the heat capacity at constant volume, from the fluctuations of the kinetic energy at constant energy (Lebowitz, Percus & Verlet 1967), or of the total energy in a heat bath: C = ⟨δE²⟩ / k T² (Allen & Tildesley 2017, 2.5)",
    keys: &[
        Key::new("after", Kind::NotNegative, Value::Number(0.0), "the time before which states do not count, while the run comes to equilibrium [time]"),
        DRIFT,
    ],
    cells: &[
        ("heat_capacity", "C of the states so far, for each particle that moves, in units of Boltzmann's constant; empty while there are few, or none fits their fluctuations"),
        ("error", "its standard error, by block averages (Flyvbjerg & Petersen 1989); empty while the run is too short for one"),
        ("states", "the number of states that count so far"),
        ("kinetic", "K = ½ Σ m v² of the particles that move, relative to the centre of mass unless drift counts [mass length² / time²]"),
        ("total", "E = K and the potential energy of all particles [mass length² / time²]"),
    ],
    times: Times::Chosen,
    usual: |_| Ok(None),
    begin: |setup, settings| {
        if setup.has_inactive() {
            return refuse("needs the same particles all the time: leave out emitters, drains and mergers");
        }
        if !setup.state.links.rods.is_empty() {
            return refuse("counts degrees of freedom, and rods take some of them: choose springs");
        }
        if setup.state.held.iter().any(|one| one.by != Hold::Fixed) {
            return refuse("needs a constant energy or a heat bath, and kinematic particles do work on the others: leave out their motion");
        }
        let ensemble = ensemble(&setup.forces)?;
        let (held, dimensions) = (setup.state.fixed(), setup.bounds.dimensions);
        let (after, drift) = (settings.number("after"), settings.flag("drift"));
        let count = moving(&setup.state, &held).0.len();
        let freedoms = f64::from(dimensions) * count.saturating_sub(usize::from(!drift)) as f64;
        if freedoms <= 0.0 {
            return refuse("has no degree of freedom to count: add particles that move, or set drift = true");
        }
        Ok(Box::new(HeatCapacity { held, ensemble, after, drift, count, freedoms, kinetic: Vec::new(), total: Vec::new() }))
    },
};

/// The fewest states from which it is estimated.
const FEWEST: usize = 8;
/// At constant energy: the largest root mean square change of the energy, as a part of that of the kinetic energy. The formula would be wrong
/// by its square, a hundredth.
const CONSTANT: f64 = 0.1;
/// In a heat bath: the part by which the temperature of the particles may differ from that of the bath beyond four standard errors,
/// for errors of methods at large steps.
const ALIKE: f64 = 0.02;

fn refuse<T>(why: &str) -> Result<T, Error> {
    Err(Error::Scene(format!("the measure `heat_capacity` {why}, or leave out the measure")))
}

/// The states that a run visits.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Ensemble {
    /// Those of one energy.
    Energy,
    /// Those of a heat bath with this k T \[energy\].
    Bath(f64),
}

/// The ensemble of components.
fn ensemble(forces: &[Box<dyn Component>]) -> Result<Ensemble, Error> {
    let mut found = Ensemble::Energy;
    for force in forces {
        let (name, properties) = (force.name(), force.properties());
        if properties.barostat.is_some() {
            return refuse(&format!("is that at constant volume, and {name} changes the box: leave out {name}"));
        }
        match properties.temperature.filter(|_| properties.canonical) {
            Some(temperature) => found = Ensemble::Bath(temperature),
            None if properties.thermostat => {
                return refuse(&format!(
                    "follows from fluctuations at constant energy or in a heat bath, and those under {name} are of neither: choose csvr, \
                     nose_hoover, langevin or andersen, or no thermostat"
                ));
            }
            None if properties.constrains || properties.breaks_bonds || !properties.dissipates.is_empty() => {
                return refuse(&format!("needs a constant energy or a heat bath, and {name} changes the energy: leave out {name}"));
            }
            None => (),
        }
    }
    Ok(found)
}

/// Fluctuations of a run.
#[derive(Debug)]
pub struct HeatCapacity {
    held: Vec<bool>,
    ensemble: Ensemble,
    after: f64,
    drift: bool,
    count: usize,
    freedoms: f64,
    kinetic: Vec<f64>,
    total: Vec<f64>,
}

/// A heat capacity per particle, in units of Boltzmann's constant, and its standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Estimate {
    /// The heat capacity.
    pub value: f64,
    /// Its standard error.
    pub error: Option<f64>,
}

/// The mean of a series, and its fluctuations: their mean square, and the standard errors of both.
struct Fluctuations {
    mean: f64,
    error: Option<f64>,
    square: f64,
    square_error: Option<f64>,
}

impl Fluctuations {
    fn of(values: &[f64]) -> Self {
        let mean = values.iter().sum::<f64>() / values.len() as f64;
        let squares: Vec<f64> = values.iter().map(|x| (x - mean).powi(2)).collect();
        let square = squares.iter().sum::<f64>() / values.len() as f64;
        Self { mean, error: blocks::error(values), square, square_error: blocks::error(&squares) }
    }
}

impl HeatCapacity {
    /// The ensemble of the run.
    #[must_use]
    pub fn ensemble(&self) -> Ensemble {
        self.ensemble
    }
    /// The number of states that count.
    #[must_use]
    pub fn states(&self) -> usize {
        self.kinetic.len()
    }
    /// The mean temperature k T of the states that count, 2 ⟨K⟩ / f \[energy\].
    #[must_use]
    pub fn temperature(&self) -> f64 {
        2.0 * self.kinetic.iter().sum::<f64>() / (self.states() as f64 * self.freedoms)
    }
    /// The estimate of all states that count.
    ///
    /// # Errors
    /// Why they have none, in a few words.
    pub fn estimate(&self) -> Result<Estimate, String> {
        let states = self.states();
        if states < FEWEST {
            return Err(format!("the run is too short: {states} states count, and {FEWEST} are the fewest"));
        }
        let particles = self.count as f64;
        let kinetic = Fluctuations::of(&self.kinetic);
        match self.ensemble {
            Ensemble::Energy => {
                let total = Fluctuations::of(&self.total);
                let (change, swing) = (total.square.sqrt(), kinetic.square.sqrt());
                // Sums of energies in single precision are no better than this.
                let rounding = 1e-6 * (kinetic.mean.abs() + total.mean.abs());
                if change > CONSTANT * swing + rounding {
                    return Err(format!(
                        "the energy is not constant: it changes by {change:.1e}, and the kinetic energy by {swing:.1e} (root mean squares); choose a \
                         smaller dt, or forces that conserve it"
                    ));
                }
                let part = 0.5 * self.freedoms / kinetic.mean.powi(2);
                let left = 1.0 - part * kinetic.square;
                if left.is_nan() || left <= 0.0 {
                    return Err("the kinetic energy fluctuates more than it can in equilibrium: set `after` to a later time".to_owned());
                }
                let value = 0.5 * self.freedoms / left / particles;
                Ok(Estimate { value, error: kinetic.square_error.map(|error| value * part * error / left) })
            }
            Ensemble::Bath(temperature) => {
                let ratio = self.temperature() / temperature;
                // Without an error, as of a run that drifts, a fifth is far off.
                let room = ALIKE + kinetic.error.map_or(0.2, |error| 4.0 * error / kinetic.mean);
                if (ratio - 1.0).abs() > room {
                    return Err(format!(
                        "the particles have {ratio:.3} of the temperature of the bath: set `after` to a later time, or `drift` as the thermostat does"
                    ));
                }
                let total = Fluctuations::of(&self.total);
                let unit = temperature.powi(2) * particles;
                Ok(Estimate { value: total.square / unit, error: total.square_error.map(|error| error / unit) })
            }
        }
    }
    /// Counts a state.
    fn add(&mut self, time: f64, kinetic: f64, total: f64) {
        if time >= self.after {
            self.kinetic.push(kinetic);
            self.total.push(total);
        }
    }
}

impl Series for HeatCapacity {
    fn take(&mut self, moment: &Moment<'_>) -> Result<Vec<Row>, Error> {
        let (state, energies) = (moment.state, moment.state.energies()?);
        let (all, mean) = moving(state, &self.held);
        let mean = if self.drift { glam::DVec3::ZERO } else { mean };
        let kinetic: f64 =
            all.iter().map(|i| 0.5 * state.mass()[*i] * (state.velocity()[*i] - mean).length_squared()).sum();
        // Fixed particles have their part of the energy of pairs.
        let total = kinetic + energies.iter().sum::<f64>();
        self.add(state.time, kinetic, total);
        let estimate = self.estimate().ok();
        let cell = |x: Option<f64>| x.map_or(Cell::Empty, Cell::from);
        let states = Cell::Whole(self.states() as u64);
        let error = estimate.and_then(|one| one.error);
        Ok(vec![vec![cell(estimate.map(|one| one.value)), cell(error), states, kinetic.into(), total.into()]])
    }
    fn recall(&mut self, _: u64, cells: &[&str]) {
        self.add(number(cells, 0), number(cells, 4), number(cells, 5));
    }
    fn follow(&mut self, setup: &Setup) -> Result<(), Error> {
        // Where energy is no longer kept, the states show it. Those so far are of other forces.
        self.ensemble = ensemble(&setup.forces).unwrap_or(Ensemble::Energy);
        self.kinetic.clear();
        self.total.clear();
        Ok(())
    }
    fn summary(&self) -> Option<String> {
        let ensemble = match self.ensemble {
            Ensemble::Energy => "constant energy".to_owned(),
            Ensemble::Bath(temperature) => format!("heat bath of {temperature}"),
        };
        let states = self.states();
        Some(match self.estimate() {
            Ok(Estimate { value, error: Some(error) }) => {
                format!("heat capacity {value:.4} ± {error:.4} k per particle ({ensemble}, {states} states)")
            }
            Ok(Estimate { value, error: None }) => format!(
                "heat capacity {value:.4} k per particle ({ensemble}), without an error: the run is too short, its {states} states have fewer than \
                 8 independent blocks; run longer, or set `after` to a later time"
            ),
            Err(why) => format!("no heat capacity: {why}"),
        })
    }
}
