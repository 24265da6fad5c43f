//! Counts of pending, active and removed particles.

use super::{Measure, Moment, Row, Series, Times};
use crate::error::Error;
use crate::life::Population;
use crate::settings::Settings;

/// `population.csv`.
pub const MEASURE: Measure = Measure {
    name: "population",
    about: "counts of pending, active and removed particles",
    keys: &[],
    cells: &[
        ("pending", "particles that are not spawned yet"),
        ("active", "particles that move"),
        ("removed", "particles that were removed"),
        ("spawned", "particles that were ever active"),
        ("mass", "the mass of all [mass]"),
    ],
    times: Times::Chosen,
    usual: |setup| Ok(setup.has_inactive().then(Settings::default)),
    begin: |_, _| Ok(Box::new(Counts::default())),
};

/// The counts of a run.
#[derive(Debug, Default)]
pub struct Counts(Option<Population>);

impl Counts {
    /// The last of them.
    #[must_use]
    pub fn last(&self) -> Option<Population> {
        self.0
    }
}

impl Series for Counts {
    fn take(&mut self, moment: &Moment<'_>) -> Result<Vec<Row>, Error> {
        let state = moment.state;
        let of = state.population();
        self.0 = Some(of);
        let mass = state.mass().iter().sum::<f64>();
        let counts = [of.pending, of.active, of.removed, of.active + of.removed].map(|count| count as f64);
        Ok(vec![counts.into_iter().chain([mass]).map(Into::into).collect()])
    }
    // A run that continues counts again before it ends.
    fn recall(&mut self, _: u64, _: &[&str]) {}
    fn summary(&self) -> Option<String> {
        let of = self.0?;
        Some(format!("{} active, {} removed, {} pending", of.active, of.removed, of.pending))
    }
}
