//! Statistics of solves, on the device until they are read.

use super::{STATE, State, System, plain, reference, with};
use crate::error::Error;
use crate::kernel::{Host, Kernel};

/// The field that holds it.
pub const NAME: &str = "solve_report";
/// Its words.
pub const WORDS: usize = 6;

/// The kernel; a step by Newton's method has converged when its residual meets the tolerance.
pub fn kernel(system: &System<'_>, newton: bool) -> Result<Kernel, Error> {
    let run = move |host: &Host| {
        let state = State::of(&host.reading::<f32>(STATE)?);
        let mut report = host.writing::<u32>(NAME)?;
        let converged = if newton { state.settled > 0.0 } else { (0.5..1.5).contains(&state.code) };
        if !converged {
            if report[1] == 0 {
                report[2] = host.world().step;
            }
            report[1] += 1;
        }
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a count")]
        let iterations = state.total as u32;
        report[0] += 1;
        report[3] = report[3].max(iterations);
        report[4] = iterations;
        report[5] = if converged { 1 } else { 3 - u32::from(state.broken > 0.0) };
        Ok(())
    };
    let kernel = plain("report", system, crate::shader!("integrators/solve_report.wgsl"), reference(run))?;
    let mut kernel = with(kernel, &[("NEWTON", f64::from(u8::from(newton)))]);
    kernel.passes[0].threads.count = 1;
    kernel.passes[0].work = 1;
    kernel.sizes.push((NAME.into(), WORDS as u64));
    Ok(kernel)
}
