//! The summary at the end of a run.

use std::time::Duration;

use motes::Energy;
use motes::run::Looks;

use super::course;
use super::words::{duration, large};
use motes::diagnose::Conserved;

/// The change of the energy, final and largest. If the initial total is nearly 0, as of a pendulum at its pivot's height, changes are
/// relative to the maximum kinetic energy.
pub fn energy(rows: &[Energy], looks: &Looks, conserved: &Conserved) -> String {
    let (first, last) = (rows.first().copied().unwrap_or_default(), rows.last().copied().unwrap_or_default());
    let word = match conserved {
        Conserved { energy: true, .. } => "error".to_owned(),
        Conserved { takers, .. } if takers.is_empty() => "not conserved, change".to_owned(),
        Conserved { takers, .. } => format!("not conserved ({}), change", takers.join("; ")),
    };
    let ends = format!("energy {:.6e} → {:.6e}", first.total(), last.total());
    if first.total().abs() < 0.01 * looks.kinetic {
        let (change, most) = ((last.total() - first.total()) / looks.kinetic, looks.change / looks.kinetic);
        let (largest, count) = (looks.kinetic, looks.count);
        return format!(
            "{ends}, {word} {change:+.1e} of the largest kinetic energy, {largest:.3e}, at most {most:.1e} in {count} measurements"
        );
    }
    // Absolute where there is no energy at all.
    let most = if first.total() == 0.0 { looks.change } else { looks.change / first.total().abs() };
    format!("{ends}, {word} {:+.1e}, at most {most:.1e} in {} measurements", last.drift_from(&first), looks.count)
}

/// The change of the momenta that are conserved, and of an angular momentum that only some named mechanisms change.
pub fn momentum(rows: &[Energy], conserved: &Conserved) -> Option<String> {
    let (first, last) = (rows.first()?, rows.last()?);
    let (p, l) = (last.momentum - first.momentum, last.angular_momentum - first.angular_momentum);
    let size = first.angular_momentum.length();
    let part = if size > 0.0 { format!(" of {size:.3e}") } else { String::new() };
    let turning = match conserved {
        Conserved { angular_momentum: true, .. } => format!(", angular momentum by {:.1e}", l.length()),
        Conserved { turners, .. } if turners.is_empty() => String::new(),
        Conserved { turners, .. } => {
            format!(", angular momentum not conserved ({}), change {:.1e}{part}", turners.join("; "), l.length())
        }
    };
    conserved.momentum.then(|| format!("momentum changed by {:.1e}{turning}", p.length()))
}

/// The speed of a run.
pub fn speed(steps: u64, count: usize, stepping: Duration, took: Duration) -> String {
    let rate = steps as f64 / stepping.as_secs_f64().max(1e-9);
    format!(
        "{} in {} ({} with measurements and files): {} steps/s, {} particle-steps/s",
        course::steps(steps),
        duration(stepping),
        duration(took),
        large(rate),
        large(rate * count as f64)
    )
}

/// The number of broken springs.
pub fn broken(whole: usize, left: usize) -> String {
    format!(
        "{} of {whole} springs are broken; the remaining ones are in the files of links",
        whole.saturating_sub(left)
    )
}
