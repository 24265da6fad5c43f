//! Measurements of the energy between the states that are written: these seldom include the extreme values of a run.

use crate::measure::Energy;

/// The approximate number of measurements in a run.
const LOOKS: u64 = 64;
/// The minimum number of steps between two: each costs about as much as a step.
const APART: u64 = 20;

/// The statistics of the energies.
#[derive(Debug, Clone, Copy, Default)]
pub struct Looks {
    /// Steps between two measurements; 0 where there are none.
    interval: u64,
    /// The largest kinetic energy.
    pub kinetic: f64,
    /// The largest change of the total energy since the first state.
    pub change: f64,
    /// The number of measured states.
    pub count: u64,
}

impl Looks {
    /// For a run of `steps` steps. There are none with adaptive steps: a measurement would divide a step.
    pub(super) fn new(steps: u64, adaptive: bool) -> Self {
        Self { interval: if adaptive { 0 } else { (steps / LOOKS).max(APART) }, ..Self::default() }
    }
    /// The step of the next measurement.
    pub(super) fn next(&self, done: u64) -> u64 {
        done.checked_div(self.interval).map_or(u64::MAX, |looks| (looks + 1) * self.interval)
    }
    /// Whether a measurement is due at this step.
    pub(super) fn is_due(&self, done: u64) -> bool {
        self.interval > 0 && done.is_multiple_of(self.interval)
    }
    /// Adds a state of a run that began with `first`.
    pub(super) fn take(&mut self, row: &Energy, first: &Energy) {
        self.kinetic = self.kinetic.max(row.kinetic);
        self.change = self.change.max((row.total() - first.total()).abs());
        self.count += 1;
    }
}
