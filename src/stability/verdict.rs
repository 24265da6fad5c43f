//! The verdict on a time step for a network of springs: stable, possibly unstable by the bound, or certainly unstable.

use super::bound::Bound;
use super::mode::{Mode, Network};
use super::oscillator::Oscillator;
use super::{acting, others};
use crate::error::Error;
use crate::integrators::{Integrator, SymplecticEuler};
use crate::simulation::Setup;
use crate::visit::Over;

/// A function that makes the integrator, with its settings.
pub type Build<'a> = &'a (dyn Fn() -> Box<dyn Integrator> + Sync);

/// A part of the largest step: at the limit itself a symplectic method keeps energies within bounds that are wide.
const MARGIN: f64 = 0.9;

/// The stability of springs, joints and dihedrals under the steps of a setup.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Verdict {
    /// An upper bound of the network's stiffness, and its location.
    pub bound: Bound,
    /// The largest ω² of joints and dihedrals \[1 / time²\].
    pub bending: f64,
    /// The largest dt that is safe by all of this, and by what forces of each particle add (drag, harmonic attractors) \[time\]; infinite where any is stable, 0 where none is.
    pub safe: f64,
    /// The dt from which on modes that the network has at the start grow tenfold in the run; above `safe`, but for
    /// rounding. Infinite where dt is safe: modes were not looked at.
    pub lost: f64,
    /// Whether the springs' damping limits the step, and not their stiffness.
    pub by_damping: bool,
}

impl Verdict {
    /// For a setup that runs for `steps` steps; `None` where no spring, joint or dihedral acts.
    ///
    /// # Errors
    /// Errors of a simulation of one particle by the references.
    pub async fn of(setup: &Setup, build: Build<'_>, steps: u64) -> Result<Option<Self>, Error> {
        // Two forces of a kind act twice. What a user's law does is not known.
        let laws: Vec<_> = setup.forces.iter().flat_map(|force| force.laws()).filter(|law| !law.wgsl.law).collect();
        let acting_over = |over| laws.iter().filter(|law| law.over == over).count() as f64;
        let (bends, twists) = (acting_over(Over::Joints), acting_over(Over::Dihedrals));
        let (springs, links) = (&*acting(setup), &setup.state.links);
        let bending = bends > 0.0 && !links.joints.is_empty() || twists > 0.0 && !links.dihedrals.is_empty();
        if springs.is_empty() && !bending {
            return Ok(None);
        }
        let mut masses = setup.state.mass().to_vec();
        for held in &setup.state.held {
            if let Some(mass) = masses.get_mut(held.id as usize) {
                *mass = f64::INFINITY;
            }
        }
        let bound = Bound::of(springs, &masses);
        let duration = setup.dt * steps as f64;
        let bending = others::corners(setup, &masses, bends, twists);
        let (stiffness, damping) = others::each(setup);
        let highest =
            Mode { stiffness: bound.stiffness.sum + bending + stiffness, damping: bound.damping.sum + damping };
        let mut safe = safe(build, highest, duration).await?;
        if build().is_implicit() && bending > 0.0 {
            // They stay explicit in the same step.
            let mode = Mode { stiffness: bending, damping: 0.0 };
            safe = safe.min(limit(&|| Box::new(SymplecticEuler), mode, duration).await?);
        }
        let by_damping = if safe.is_finite() && safe > 0.0 {
            safe * highest.stiffness < 2.0 * highest.damping
        } else {
            highest.stiffness == 0.0
        };
        let mut verdict = Self { bound, bending, safe, lost: f64::INFINITY, by_damping };
        if setup.dt > safe && !springs.is_empty() {
            let network = Network::new(springs, &masses, setup.state.position(), &setup.bounds);
            for mode in [network.quickest(), network.most_damped()] {
                verdict.lost = verdict.lost.min(limit(build, mode, duration).await?);
            }
        }
        Ok(Some(verdict))
    }
    /// The number of substeps into which a step of dt must be divided to be stable, with a margin of a tenth; 1 if it is stable already,
    /// and `None` if no division helps.
    #[must_use]
    pub fn substeps(&self, dt: f64) -> Option<u64> {
        let parts = (dt / (MARGIN * self.safe)).ceil();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a whole number that fits")]
        match parts {
            _ if dt <= self.safe => Some(1),
            parts if parts <= f64::from(u32::MAX) => Some(parts as u64),
            _ => None,
        }
    }
}

pub(super) async fn limit(build: Build<'_>, mode: Mode, duration: f64) -> Result<f64, Error> {
    // Single precision holds no step for it.
    if mode.stiffness > f64::from(f32::MAX) {
        return Ok(0.0);
    }
    Oscillator::new(build(), mode.stiffness.sqrt(), mode.damping)?.largest_step(duration).await
}

/// The stability limit of all modes up to the highest: its own, half as stiff and as damped, damped only, and undamped. The last
/// counts only for methods that are stable for undamped oscillations: others, such as Euler's, require damping.
async fn safe(build: Build<'_>, highest: Mode, duration: f64) -> Result<f64, Error> {
    let Mode { stiffness, damping } = highest;
    let mut least = combined(build, highest, duration).await?;
    if damping == 0.0 || stiffness == 0.0 {
        return Ok(least);
    }
    least = least.min(limit(build, Mode { stiffness: 0.0, ..highest }, duration).await?);
    // A growth per step that no rounding makes, where ω dt is one half.
    if Oscillator::new(build(), 1.0, 0.0)?.growth(0.5).await? < 1.0 + 1e-9 {
        least = least.min(limit(build, Mode { damping: 0.0, ..highest }, duration).await?);
    }
    Ok(least)
}

/// The stability limit of the highest mode, and of one half as stiff and as damped.
pub(super) async fn combined(build: Build<'_>, highest: Mode, duration: f64) -> Result<f64, Error> {
    let least = limit(build, highest, duration).await?;
    if highest.damping == 0.0 || highest.stiffness == 0.0 {
        return Ok(least);
    }
    let half = Mode { stiffness: 0.5 * highest.stiffness, damping: 0.5 * highest.damping };
    Ok(least.min(limit(build, half, duration).await?))
}
