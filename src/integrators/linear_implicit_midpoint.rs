//! The implicit midpoint rule by one linear solve, of forces linearized about the start of the step.

use super::{Explicit, Form, Implicit, Integrator, Step};

/// `linear_implicit_midpoint`
#[derive(Clone)]
pub struct LinearImplicitMidpoint;

impl Integrator for LinearImplicitMidpoint {
    fn name(&self) -> &'static str {
        "linear_implicit_midpoint"
    }
    fn order(&self) -> u32 {
        2
    }
    /// For laws with a Jacobian; it is 1 for others.
    fn order_with_velocity(&self) -> u32 {
        2
    }
    fn is_implicit(&self) -> bool {
        true
    }
    fn step(&self, s: &mut Step) {
        s.solve(Implicit { part: 0.5, until: 0.5, explicit: Explicit::Ahead, form: Form::Linear });
        s.extrapolate();
        s.settle(1.0);
    }
}
