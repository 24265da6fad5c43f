//! The tolerances of implicit integrators.

use crate::error::Error;

/// The tolerances and iteration limits of implicit integrators.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solver {
    /// The tolerance of the residual, relative to the first one of the step.
    pub tolerance: f64,
    /// The maximum number of conjugate-gradient iterations in one linear solve. Each unneeded one costs a dispatch that does nothing.
    pub iterations: u32,
    /// The maximum number of linear solves of Newton's method in one step; the linear integrators do one.
    pub solves: u32,
}

/// The smallest tolerance that single precision reliably reaches: its floor is at about 5e-7.
pub const LEAST_TOLERANCE: f64 = 1e-6;
/// The limit of iterations: a step is written out in full.
pub const MOST_ITERATIONS: u32 = 10_000;
/// The limit of solves.
pub const MOST_SOLVES: u32 = 100;

impl Default for Solver {
    fn default() -> Self {
        Self { tolerance: 1e-3, iterations: 100, solves: 8 }
    }
}

impl Solver {
    /// Checks whether the numbers are valid.
    ///
    /// # Errors
    /// [`Error::Scene`] with the invalid number.
    pub fn check(&self) -> Result<(), Error> {
        let Self { tolerance, iterations, solves } = *self;
        if !(LEAST_TOLERANCE..1.0).contains(&tolerance) {
            return Err(Error::Scene(format!(
                "the solver's tolerance is {tolerance:e}: it must be at least {LEAST_TOLERANCE:e}, the limit of \
                 single precision, and below 1"
            )));
        }
        for (name, n, most) in [("iterations", iterations, MOST_ITERATIONS), ("solves", solves, MOST_SOLVES)] {
            if !(1..=most).contains(&n) {
                return Err(Error::Scene(format!("the solver has {n} {name}: choose 1 to {most}")));
            }
        }
        Ok(())
    }
}
