//! Restart data that a step saves for the next one, and statistics of its solves. Measurements between steps change nothing.

use std::sync::Arc;

use super::{Dfsph, KAPPA, STATE, STATES, WARM_START};
use crate::error::Error;
use crate::kernel::{Column, Host, Kernel, Kind, Shape};

/// The field with the statistics of the solves.
pub const REPORT: &str = "dfsph_report";
/// Words of each of the two solves; the first is the divergence solve.
const EACH: usize = 6;
/// Its words.
pub const WORDS: usize = 2 * EACH;
/// The mean errors after the solves of the last step.
pub const ERRORS: &str = "dfsph_errors";

/// The columns of a fluid whose pressure is solved for.
#[must_use]
pub fn columns() -> Vec<Column> {
    let about =
        "κ of the last step, of the solve for the divergence and of that for the density, with which the next begins";
    vec![Column::new(WARM_START, Kind::Scalar, "length² / time²", about).shaped(Shape::Slots(2))]
}

/// The kernel.
pub fn kernel(of: &Dfsph<'_>) -> Result<Kernel, Error> {
    let reference = move |host: &Host| {
        host.writing::<f32>(WARM_START)?.copy_from_slice(&host.reading::<f32>(KAPPA)?);
        let states = host.reading::<f32>(STATES)?;
        let (mut report, mut errors) = (host.writing::<u32>(REPORT)?, host.writing::<f32>(ERRORS)?);
        let solves = states.chunks_exact(STATE).zip(report.chunks_exact_mut(EACH));
        for ((state, report), error) in solves.zip(errors.iter_mut()) {
            #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
            let iterations = state[0] as u32;
            if (state[1] - 1.0).abs() > 0.0 {
                if report[1] == 0 {
                    report[2] = host.world().step;
                }
                report[1] += 1;
            }
            report[0] += 1;
            report[3] = report[3].max(iterations);
            report[4] = iterations;
            report[5] = report[5].wrapping_add(iterations);
            *error = state[2];
        }
        Ok(())
    };
    let files = [crate::shader!("sph/dfsph/keep.wgsl")];
    of.plain("fluid keep", &files, &[], of.problem.capacity.max(2), Arc::new(reference))
}
