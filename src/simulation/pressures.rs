//! Statistics of the pressure solves of a run.

use super::Simulation;
use crate::error::Error;
use crate::kernel::{Array, Backend};
use crate::sph::{DFSPH_ERRORS, DFSPH_REPORT, DFSPH_WORDS};

/// Statistics of one of the two pressure solves of a step of a fluid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PressureSolves {
    /// The number of solves.
    pub solves: u32,
    /// The number of solves that did not converge.
    pub failures: u32,
    /// The first step that did not converge, counted from 0.
    pub first_failure: Option<u32>,
    /// The largest number of iterations in one step.
    pub most_iterations: u32,
    /// The iterations of the last step.
    pub iterations: u32,
    /// The iterations of all steps; wraps at 2³².
    pub all_iterations: u32,
    /// The mean error after the last step, relative to the density.
    pub error: f64,
}

impl<B: Backend> Simulation<B> {
    /// Statistics of the divergence solve and of the density solve; `None` where there is no pressure solve.
    ///
    /// # Errors
    /// Errors of reading.
    pub async fn pressure_solves(&mut self) -> Result<Option<[PressureSolves; 2]>, Error> {
        if !self.reports[1] {
            return Ok(None);
        }
        self.settle().await?;
        let report = self.backend.read(DFSPH_REPORT, &Array::Uint(Vec::new()), DFSPH_WORDS).await?;
        let errors = self.backend.read(DFSPH_ERRORS, &Array::Float(Vec::new()), 2).await?;
        let (Array::Uint(report), Array::Float(errors)) = (report, errors) else { return Ok(None) };
        let one = |which: usize| {
            let words = report.get(which * DFSPH_WORDS / 2..(which + 1) * DFSPH_WORDS / 2)?;
            let [solves, failures, first, most_iterations, iterations, all_iterations] = *words else { return None };
            let first_failure = (failures > 0).then_some(first);
            let error = errors.get(which).copied()?;
            (solves > 0).then_some(PressureSolves {
                solves,
                failures,
                first_failure,
                most_iterations,
                iterations,
                all_iterations,
                error,
            })
        };
        Ok(one(0).zip(one(1)).map(|(divergence, density)| [divergence, density]))
    }
}
