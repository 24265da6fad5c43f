//! Stability limits of a fluid: by its speed of sound, its viscosities and XSPH.

use super::mode::Mode;
use super::oscillator::Oscillator;
use super::verdict::{Build, combined, limit};
use crate::error::Error;
use crate::integrators::SymplecticEuler;
use crate::kernel::Machine;
use crate::simulation::Setup;

/// The factor over the largest safe step above which a fluid is lost. In a dam break (25 by 16 particles, 160 steps) sound, α, ν and ε
/// above it led to energies of 10⁴ to 10⁶ times the first; below it, a surface that is not a lattice may be stable.
const LOST: f64 = 1.25;
/// The time in which nothing may grow tenfold, in units of the fastest time scale.
const PERIODS: f64 = 1e4;

/// The limits of the time step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Asks {
    /// The speed of sound.
    Sound,
    /// Viscosity, artificial or laminar.
    Friction,
    /// XSPH, whatever the step.
    Xsph,
}

/// The stability of a fluid under the steps of a setup.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Flow {
    /// The largest dt that is safe \[time\]: infinite where any is stable; whatever XSPH is.
    pub safe: f64,
    /// The step relative to the largest safe one: above 1 it is too long. For XSPH, its strength relative to the safe one.
    pub excess: f64,
    /// The limit.
    pub asks: Asks,
    /// Whether the integrator is stable for undamped oscillations, so that steps that are far too long certainly fail.
    pub sure: bool,
}

impl Flow {
    /// For a setup; `None` where there is no fluid. Adaptive steps have limits of their own, and only XSPH is checked.
    ///
    /// # Errors
    /// When there is no such fluid, and errors of a simulation of one particle by the references.
    pub async fn of(setup: &Setup, build: Build<'_>) -> Result<Option<Self>, Error> {
        let problem = setup.problem(Machine::HOST)?;
        let Some(rates) = setup
            .forces
            .iter()
            .find_map(|force| force.resolved(&problem).map(|resolved| resolved.rates).transpose())
            .transpose()?
        else {
            return Ok(None);
        };
        // Forces that are not solved for are limited like those of an explicit method.
        let build: Build<'_> = if build().is_implicit() { &|| Box::new(SymplecticEuler) } else { build };
        // The limit is sharp in so long a time, and few steps are no excuse.
        let duration = PERIODS / rates.sound.max(rates.friction);
        let of = |stiffness: f64, damping: f64| limit(build, Mode { stiffness, damping }, duration);
        let swings = Oscillator::new(build(), 1.0, 0.0)?.growth(0.5).await? < 1.0 + 1e-9;
        // A method that is not stable for oscillations is limited by friction.
        let sound = if swings { of(rates.sound * rates.sound, 0.0).await? } else { f64::INFINITY };
        let friction = of(0.0, rates.friction).await?;
        let highest = Mode { stiffness: rates.sound * rates.sound, damping: rates.friction };
        let safe = combined(build, highest, duration).await?.min(sound).min(friction);
        let asks = if sound < friction || rates.friction == 0.0 { Asks::Sound } else { Asks::Friction };
        let adaptive = setup.integrator.adaptive_step().is_some();
        let mut flow = Self { safe, excess: if adaptive { 0.0 } else { setup.dt / safe }, asks, sure: swings };
        // In units of the step.
        let drawn = rates.drawn / limit(build, Mode { stiffness: 0.0, damping: 1.0 }, PERIODS).await?;
        if drawn > flow.excess {
            flow = Self { excess: drawn, asks: Asks::Xsph, ..flow };
        }
        Ok(Some(flow))
    }
    /// Whether a run would be lost for certain.
    #[must_use]
    pub fn is_lost(&self) -> bool {
        self.sure && self.excess > LOST
    }
}
