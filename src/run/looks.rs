//! Looks at the energy between the states that are written: what is largest in a run is seldom there.

use crate::measure::Energy;

/// So many looks are taken in a run, about.
const LOOKS: u64 = 64;
/// Steps from one to the next, at least: each costs about as much as a step.
const APART: u64 = 20;

/// What was seen of the energies.
#[derive(Debug, Clone, Copy, Default)]
pub struct Looks {
    /// Steps from one look to the next; 0 where none is taken.
    interval: u64,
    /// The largest kinetic energy.
    pub kinetic: f64,
    /// The largest change of the total energy since the first state.
    pub change: f64,
    /// States that were measured.
    pub count: u64,
}

impl Looks {
    /// For a run of so many steps. Adaptive steps are left alone: a look would cut one in two.
    pub(super) fn new(steps: u64, adaptive: bool) -> Self {
        Self { interval: if adaptive { 0 } else { (steps / LOOKS).max(APART) }, ..Self::default() }
    }
    /// The step of the next look.
    pub(super) fn next(&self, done: u64) -> u64 {
        done.checked_div(self.interval).map_or(u64::MAX, |looks| (looks + 1) * self.interval)
    }
    /// Whether one is taken at this step.
    pub(super) fn is_due(&self, done: u64) -> bool {
        self.interval > 0 && done.is_multiple_of(self.interval)
    }
    /// Takes in a state of a run that began with `first`.
    pub(super) fn take(&mut self, row: &Energy, first: &Energy) {
        self.kinetic = self.kinetic.max(row.kinetic);
        self.change = self.change.max((row.total() - first.total()).abs());
        self.count += 1;
    }
}
