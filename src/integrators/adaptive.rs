//! Adaptive time steps. A method that is symplectic with a fixed step is not symplectic with adaptive steps: its energy error, which would
//! stay bounded, may drift (Skeel & Gear 1992).

use super::{Integrator, Step};
use crate::kernel::{AdaptiveStep, Column, Precision};

/// Another integrator, with steps as long as forces allow.
#[derive(Clone)]
pub struct Adaptive {
    /// The method, which must be explicit.
    pub integrator: Box<dyn Integrator>,
    /// The limits of the time step.
    pub adaptive_step: AdaptiveStep,
}

impl Integrator for Adaptive {
    fn name(&self) -> &'static str {
        self.integrator.name()
    }
    fn order(&self) -> u32 {
        self.integrator.order()
    }
    fn order_with_velocity(&self) -> u32 {
        self.integrator.order_with_velocity()
    }
    fn is_implicit(&self) -> bool {
        self.integrator.is_implicit()
    }
    fn adaptive_step(&self) -> Option<AdaptiveStep> {
        Some(self.adaptive_step)
    }
    fn fixed_step(&self) -> Option<&'static str> {
        self.integrator.fixed_step()
    }
    fn in_fixed_steps(&self) -> Box<dyn Integrator> {
        self.integrator.in_fixed_steps()
    }
    fn precision(&self) -> Precision {
        self.integrator.precision()
    }
    fn columns(&self) -> Vec<Column> {
        self.integrator.columns()
    }
    fn start(&self, s: &mut Step) {
        self.integrator.start(s);
    }
    fn step(&self, s: &mut Step) {
        self.integrator.step(s);
    }
}
