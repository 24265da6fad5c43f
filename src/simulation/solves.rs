//! Statistics of the implicit solves of a run.

use super::Simulation;
use crate::error::Error;
use crate::integrators::{RADAU_STEP, RADAU_STEP_WORDS, SOLVE_REPORT, SOLVE_REPORT_WORDS, SOLVE_STATE};
use crate::kernel::{Array, Backend};

/// The outcome of a solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// The tolerance was reached.
    Converged,
    /// The matrix was not positive along a direction, or a number was not finite.
    BrokenDown,
    /// More iterations, or more solves, would have been required.
    RanOut,
}

/// Statistics of the implicit solves of a run. A step counts as one solve, however many linear ones it takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solves {
    /// The number of solves.
    pub solves: u32,
    /// The number of solves that did not converge.
    pub failures: u32,
    /// The first step that did not converge, counted from 0.
    pub first_failure: Option<u32>,
    /// The largest number of conjugate-gradient iterations in one step.
    pub most_iterations: u32,
    /// The iterations of the last step.
    pub iterations: u32,
    /// The outcome of the last step.
    pub outcome: Outcome,
    /// The last residual that was computed, relative to the first one of its step.
    pub residual: f64,
}

/// Steps along which accelerations did not settle, and adaptive ones that were tried again, see
/// [`GaussRadau`](crate::integrators::GaussRadau).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Unsettled {
    /// The number of such steps.
    pub steps: u32,
    /// The first one, counted from 0.
    pub first: u32,
}

impl<B: Backend> Simulation<B> {
    /// Steps along which accelerations did not settle so far, or adaptive ones that were tried again; `None` where there are none.
    ///
    /// # Errors
    /// Errors of reading.
    pub async fn unsettled(&mut self) -> Result<Option<Unsettled>, Error> {
        if !self.reports[2] {
            return Ok(None);
        }
        self.settle().await?;
        let all = self.backend.read(RADAU_STEP.name, &Array::Float(Vec::new()), RADAU_STEP_WORDS as usize).await?;
        let Array::Float(words) = all else { return Ok(None) };
        let [.., steps, first] = words[..] else { return Ok(None) };
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "whole numbers")]
        let (steps, first) = (steps as u32, first as u32);
        Ok((steps > 0).then_some(Unsettled { steps, first }))
    }
    /// Statistics of the implicit solves so far; `None` where there are no iterative solves.
    ///
    /// # Errors
    /// Errors of reading.
    pub async fn solves(&mut self) -> Result<Option<Solves>, Error> {
        if !self.reports[0] {
            return Ok(None);
        }
        self.settle().await?;
        let report = self.backend.read(SOLVE_REPORT, &Array::Uint(Vec::new()), SOLVE_REPORT_WORDS).await?;
        let state = self.backend.read(SOLVE_STATE, &Array::Float(Vec::new()), 4).await?;
        let (Array::Uint(report), Array::Float(state)) = (report, state) else { return Ok(None) };
        let [solves, failures, first, most_iterations, iterations, code, ..] = report[..] else { return Ok(None) };
        let (first_residual, residual) = (state.first().copied().unwrap_or(0.0), state.get(3).copied().unwrap_or(0.0));
        let outcome = match code {
            1 => Outcome::Converged,
            2 => Outcome::BrokenDown,
            _ => Outcome::RanOut,
        };
        Ok((solves > 0).then(|| Solves {
            solves,
            failures,
            first_failure: (failures > 0).then_some(first),
            most_iterations,
            iterations,
            outcome,
            residual: if first_residual > 0.0 { (residual / first_residual).sqrt() } else { 0.0 },
        }))
    }
}
