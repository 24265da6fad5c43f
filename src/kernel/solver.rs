//! How well implicit integrators solve.

use crate::error::Error;

/// How well implicit integrators solve their equations.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solver {
    /// What may be left of the residual, as a part of the first one of the step.
    pub tolerance: f64,
    /// Iterations of conjugate gradients in one linear solve, at most. Those that are not needed cost a dispatch that
    /// does nothing.
    pub iterations: u32,
    /// Linear solves of Newton's method in one step, at most; the linear forms do one.
    pub solves: u32,
}

/// The best that single precision is sure to reach: its floor is at about 5e-7.
pub const LEAST_TOLERANCE: f64 = 1e-6;
/// Iterations, at most: a step is written out in full.
pub const MOST_ITERATIONS: u32 = 10_000;
/// Solves, at most.
pub const MOST_SOLVES: u32 = 100;

impl Default for Solver {
    fn default() -> Self {
        Self { tolerance: 1e-3, iterations: 100, solves: 8 }
    }
}

impl Solver {
    /// Whether it can be done.
    ///
    /// # Errors
    /// [`Error::Scene`] with the number that makes no sense.
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
