//! The report on the implicit solves of a run.

use motes::simulation::{Outcome, PressureSolves, Solves, Unsettled};
use serde_json::json;

use super::progress::Progress;

/// Reports the solves, and a remedy if some did not converge.
pub fn tell(progress: &Progress, solves: Option<Solves>, pressures: Option<[PressureSolves; 2]>) {
    tell_pressures(progress, pressures);
    let Some(Solves { solves: all, failures, first_failure, most_iterations, iterations, outcome, residual }) = solves
    else {
        return;
    };
    progress.event(
        "solves",
        json!({ "solves": all, "failures": failures, "first_failure": first_failure, "most_iterations": most_iterations,
            "iterations": iterations, "residual": residual }),
    );
    progress.conclude(&format!(
        "{all} implicit solves: {iterations} iterations in the last step, {most_iterations} at most, residual {residual:.1e}"
    ));
    if let Some(step) = first_failure {
        let why = match outcome {
            Outcome::BrokenDown => "its matrix is not positive definite: choose a smaller dt, or add damping",
            _ => "raise solver.iterations or solver.solves, loosen solver.tolerance, or choose a smaller dt",
        };
        progress.say(&format!("warning: {failures} of {all} solves did not converge, the first in step {step}: {why}"));
    }
}

/// Reports steps along which accelerations did not settle, or adaptive ones that were tried again.
pub fn tell_unsettled(progress: &Progress, unsettled: Option<Unsettled>, is_adaptive: bool) {
    let Some(Unsettled { steps, first }) = unsettled else { return };
    progress.event("unsettled", json!({ "steps": steps, "first": first }));
    if is_adaptive {
        progress.conclude(&format!("steps that were tried again, shorter: {steps}, the first of them step {first}"));
    } else {
        progress.say(&format!(
            "warning: accelerations did not settle along steps: {steps} of them, the first of which is step {first}: choose a smaller dt, or adaptive = true"
        ));
    }
}

/// Reports the pressure solves, and a remedy if some did not converge.
fn tell_pressures(progress: &Progress, solves: Option<[PressureSolves; 2]>) {
    for (what, one) in ["divergence", "density"].into_iter().zip(solves.into_iter().flatten()) {
        let PressureSolves { solves, failures, first_failure, most_iterations, iterations, all_iterations, error } =
            one;
        let mean = f64::from(all_iterations) / f64::from(solves.max(1));
        progress.event(
            "pressure_solves",
            json!({ "of": what, "solves": solves, "failures": failures, "first_failure": first_failure,
                "most_iterations": most_iterations, "iterations": iterations, "mean_iterations": mean, "error": error }),
        );
        progress.conclude(&format!(
            "{solves} solves for the {what} of the fluid: {mean:.1} iterations in the mean, {most_iterations} at most, {iterations} \
             in the last step, mean error {error:.1e}"
        ));
        if let Some(step) = first_failure {
            progress.say(&format!(
                "warning: {failures} of {solves} solves for the {what} of the fluid did not converge, the first in step {step}: \
                 raise max_iterations, loosen the tolerance, or choose a smaller dt"
            ));
        }
    }
}
