//! Adaptive time steps. A method that is symplectic with a fixed step is not symplectic with adaptive steps: its energy error, which would
//! stay bounded, may drift (Skeel & Gear 1992).

use super::{Integrator, Step};
use crate::kernel::AdaptiveStep;

/// Another integrator, with steps as long as forces allow.
#[derive(Clone)]
pub struct Adaptive {
    /// The method, which must be explicit.
    pub integrator: Box<dyn Integrator>,
    /// The limits of the time step.
    pub adaptive_step: AdaptiveStep,
}

impl Integrator for Adaptive {
    fn wrapped(&self) -> Option<&dyn Integrator> {
        Some(self.integrator.as_ref())
    }
    fn order(&self) -> u32 {
        self.integrator.order()
    }
    fn is_symplectic(&self) -> bool {
        false
    }
    fn damps_at_any_step(&self) -> bool {
        false
    }
    fn adaptive_step(&self) -> Option<AdaptiveStep> {
        Some(self.adaptive_step)
    }
    fn in_fixed_steps(&self) -> Box<dyn Integrator> {
        self.integrator.in_fixed_steps()
    }
    fn step(&self, s: &mut Step) {
        self.integrator.step(s);
    }
}
