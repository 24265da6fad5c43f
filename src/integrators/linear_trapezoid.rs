//! The trapezoid rule by one linear solve, of forces linearized about the middle of the step.

use super::{Explicit, Form, Implicit, Integrator, Step};

/// `linear_trapezoid`
#[derive(Clone)]
pub struct LinearTrapezoid;

impl Integrator for LinearTrapezoid {
    fn name(&self) -> &'static str {
        "linear_trapezoid"
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
        s.evaluate();
        s.drift(0.5);
        s.kick(0.5);
        s.solve(Implicit { part: 0.5, until: 1.0, explicit: Explicit::Ahead, form: Form::Linear });
        s.settle(0.5);
    }
}
