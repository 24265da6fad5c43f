//! What a run says of its implicit solves, and which laws are solved for.

use glam::DVec3;
use motes::forces::{Law, Over};
use motes::integrators::implicit;
use motes::kernel::Machine;
use motes::simulation::{Outcome, PressureSolves, Solves};
use motes::{Error, Setup};
use serde_json::json;

use super::advice::acceleration_at;
use super::flow;
use super::progress::Progress;

/// Tells what became of the solves, and the way out where some did not converge.
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
            Outcome::BrokenDown => "its matrix is not positive: choose a smaller dt, or a law that damps",
            _ => "raise solver.iterations or solver.solves, loosen solver.tolerance, or choose a smaller dt",
        };
        progress.say(&format!("warning: {failures} of {all} solves did not converge, the first in step {step}: {why}"));
    }
}

/// Tells what became of the solves for pressure, and the way out where some did not converge.
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

/// Which laws an implicit integrator solves for, and which it takes as they are where the solve begins.
pub fn remark(setup: &Setup, integrator: &str) -> Result<String, Error> {
    let (mut solved, mut limiting, mut constant) = (Vec::new(), Vec::new(), Vec::new());
    for (force, is_solved) in setup.forces.iter().zip(implicit(&setup.forces)) {
        for law in force.laws() {
            let name = format!("`{}`", law.name);
            match is_solved {
                true => solved.push(name),
                false if is_constant(&law, setup)? => constant.push(name),
                false => limiting.push(name),
            }
        }
    }
    limiting.extend(flow::flows(&setup.forces).then(|| "`fluid`".to_owned()));
    let listed = |names: Vec<String>| if names.is_empty() { "none".to_owned() } else { names.join(", ") };
    let free = if constant.is_empty() { String::new() } else { format!("; constant: {}", constant.join(", ")) };
    let (solved, limiting) = (listed(solved), listed(limiting));
    Ok(format!("{integrator} solves for {solved}; explicit in the same step, with a limit on dt: {limiting}{free}"))
}

/// Whether a law is the same everywhere, at any velocity: no step is too long for it.
fn is_constant(law: &Law, setup: &Setup) -> Result<bool, Error> {
    let (Over::Each, Some(reference)) = (law.over, &law.reference) else { return Ok(false) };
    if law.depends_on_velocity(&setup.problem(Machine::HOST)?)? {
        return Ok(false);
    }
    let places = [DVec3::ZERO, DVec3::new(0.31, -0.23, 0.17), DVec3::new(-11.0, 17.0, 13.0)];
    let pulls = places.map(|x| acceleration_at(reference, (0.0, 0), x, setup.bounds).map(glam::DVec4::truncate));
    let [a, b, c] = pulls;
    let (a, b, c) = (a?, b?, c?);
    Ok(a == b && b == c)
}
