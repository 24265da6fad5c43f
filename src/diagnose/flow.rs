//! Steps at which a fluid is stable: remarks on them, and the refusal of those that would end in an explosion.

use crate::error::Error;
use crate::forces::Component;
use crate::simulation::Setup;
use crate::sph::Medium;
use crate::stability::{Asks, Flow};

use super::Remark;
use super::steps::digits;

/// The part of the time in which an acceleration crosses a smoothing length that a step may have (Monaghan 1992).
const COURANT: f64 = 0.25;
/// The maximum part of its density that an acceleration may add to a fluid that should vary by 1 %.
const PRESSED: f64 = 0.05;

/// Whether one of these forces makes a fluid.
#[must_use]
pub fn flows(forces: &[Box<dyn Component>]) -> bool {
    forces.iter().any(|force| force.properties().makes_fluid)
}

/// A line of how far from its limit a step is.
pub fn line(flow: &Flow, dt: f64) -> Option<String> {
    let what = match flow.asks {
        Asks::Sound => "sound",
        Asks::Friction => "viscosity",
        Asks::Xsph => return None,
    };
    let safe = flow.safe.is_finite() && flow.excess > 0.0;
    safe.then(|| {
        format!(
            "  steps        dt = {dt} is {:.2} of the stability limit by {what}, {}",
            flow.excess,
            digits(flow.safe)
        )
    })
}

/// The warning about steps that are too long, and the remedy; `None` if they are safe.
///
/// # Errors
/// [`Error::Scene`] when they are so long that the fluid would be lost.
pub fn warning(flow: &Flow, setup: &Setup) -> Result<Option<Remark>, Error> {
    if flow.excess <= 1.0 {
        return Ok(None);
    }
    let (dt, name) = (setup.dt, setup.integrator.name());
    let culprit = match flow.asks {
        Asks::Sound => "the fluid's speed of sound",
        Asks::Friction => "the fluid's viscosity (alpha, viscosity)",
        Asks::Xsph => {
            let text = format!(
                "the fluid's xsph is {:.2} times the stability limit of {name}, at any dt: it overcorrects \
                 velocities",
                flow.excess
            );
            return said(
                flow,
                Remark::warning("strong-xsph", text).with("excess", flow.excess).advice("choose 0.5 or less"),
            );
        }
    };
    let way = if flow.safe > 0.0 {
        format!("the largest dt that is safe is {}: set it, or one that is shorter", digits(flow.safe))
    } else {
        "no dt is safe: choose leapfrog".to_owned()
    };
    let text = format!("dt = {dt} is too long for {name} and {culprit}");
    let remark = Remark::warning("long-step", text).with("dt", dt).with("excess", flow.excess);
    said(flow, remark.with("largest_dt", flow.safe).advice(way))
}

fn said(flow: &Flow, remark: Remark) -> Result<Option<Remark>, Error> {
    if flow.is_lost() {
        return Err(Error::Scene(format!("this run would explode: {remark}")));
    }
    Ok(Some(Remark { text: format!("this run may explode: {}", remark.text), ..remark }))
}

/// Whether the largest initial acceleration requires a shorter step, or a higher speed of sound.
#[must_use]
pub fn hurry(medium: &Medium, dt: f64, (particle, most): (usize, f64)) -> Option<String> {
    let length = 0.5 * medium.range();
    let longest = COURANT * (length / most).sqrt();
    let pressed = if medium.sound > 0.0 { most * length / (medium.sound * medium.sound) } else { 0.0 };
    let start = format!("particle {particle} of the fluid begins with an acceleration of {most:.3e}");
    if dt > longest {
        return Some(format!("{start}, for which dt = {dt} is too long: choose {}", digits(longest)));
    }
    (pressed > PRESSED).then(|| {
        format!(
            "{start}, which compresses the fluid by {:.0} % within a smoothing length: is its tension too strong for its speed of \
             sound, or are particles too close?",
            100.0 * pressed
        )
    })
}
