//! The stability limit of springs, and remarks on steps that are too long.

use super::Remark;
use crate::integrators::{Entry, INTEGRATORS};
use crate::simulation::Setup;
use crate::stability::Verdict;

/// The spring that limits the step.
#[must_use]
pub fn culprit(verdict: &Verdict, setup: &Setup) -> String {
    if !verdict.by_damping && verdict.bending > verdict.bound.stiffness.sum {
        return format!("the stiffness of joints and dihedrals (ω² up to {:.1e})", verdict.bending);
    }
    let row = if verdict.by_damping { verdict.bound.damping } else { verdict.bound.stiffness };
    let what = if verdict.by_damping { "damping" } else { "stiffness" };
    match setup.state.links.springs.get(row.spring) {
        Some(spring) => {
            let ([a, b], k, c) = (spring.ends, spring.stiffness, spring.damping);
            format!(
                "the {what} of the springs at particle {}, most of all of spring {a}–{b} (stiffness {k}, damping {c})",
                row.particle
            )
        }
        None => format!("the {what} of the springs"),
    }
}

/// The largest safe dt, after a comma.
#[must_use]
pub fn limit(verdict: &Verdict) -> String {
    if verdict.safe.is_infinite() {
        ", which is stable at any".to_owned()
    } else {
        format!(", which is stable up to dt = {}", digits(verdict.safe))
    }
}

/// Three digits, rounded down: what is safe stays safe.
#[must_use]
pub fn digits(x: f64) -> String {
    let scale = 10f64.powf(2.0 - x.abs().log10().floor());
    let down = if x > 0.0 { (x * scale).floor() / scale } else { x };
    if down == 0.0 || (1e-3..1e5).contains(&down) {
        format!("{}", (down * 1e9).round() / 1e9)
    } else {
        format!("{down:.2e}")
    }
}

/// The warning about unstable steps of a setup, and the remedy; `None` if they are stable.
#[must_use]
pub fn unsafe_steps(verdict: &Verdict, setup: &Setup) -> Option<Remark> {
    let sure = if setup.dt > verdict.lost { "will explode" } else { "may explode" };
    let (trouble, way) = trouble(verdict, setup)?;
    let remark = Remark::warning("long-step", format!("this run {sure}: {trouble}"));
    Some(remark.with("dt", setup.dt).with("largest_dt", verdict.safe).advice(way))
}

/// Why steps are too long for springs, and what to do; nothing where they are safe.
#[must_use]
pub fn way_out(verdict: &Verdict, setup: &Setup) -> Option<String> {
    trouble(verdict, setup).map(|(trouble, way)| format!("{trouble}; {way}"))
}

/// Why steps are too long, and the way out.
fn trouble(verdict: &Verdict, setup: &Setup) -> Option<(String, String)> {
    let (dt, name) = (setup.dt, setup.integrator.name());
    let way = match verdict.substeps(dt) {
        Some(1) => return None,
        Some(parts) => format!(
            "the largest dt that is safe is {}: set it, or --auto-substeps ({parts} steps for each)",
            digits(verdict.safe)
        ),
        None => "no dt is safe: choose another integrator".to_owned(),
    };
    let spring = culprit(verdict, setup);
    Some((format!("dt = {dt} is too long for {name} and {spring}"), format!("{way}{}", others(setup, verdict))))
}

/// Integrators that are stable at any step, after a comma.
#[must_use]
pub fn others(setup: &Setup, verdict: &Verdict) -> String {
    // Joints and dihedrals stay explicit under all of them.
    if verdict.bending > 0.0 {
        return String::new();
    }
    let bears = |entry: &&Entry| entry.by_default().damps_at_any_step() && entry.name != setup.integrator.name();
    let names: Vec<_> = INTEGRATORS.iter().filter(bears).map(|entry| entry.name).collect();
    if names.is_empty() {
        String::new()
    } else {
        format!(", or take {}, which is stable at any dt", names.join(" or "))
    }
}
