//! The implicit midpoint rule (Hairer, Lubich & Wanner 2006, §II.1.1): half a step by the implicit Euler method, and on along
//! the same line. Symplectic.

use super::{Explicit, Form, Implicit, Integrator, Step};

/// `implicit_midpoint`
#[derive(Clone)]
pub struct ImplicitMidpoint;

impl Integrator for ImplicitMidpoint {
    fn name(&self) -> &'static str {
        "implicit_midpoint"
    }
    fn order(&self) -> u32 {
        2
    }
    fn is_symplectic(&self) -> bool {
        true
    }
    /// For laws with a Jacobian; it is 1 for others.
    fn order_with_velocity(&self) -> u32 {
        2
    }
    fn is_implicit(&self) -> bool {
        true
    }
    fn step(&self, s: &mut Step) {
        s.solve(Implicit { part: 0.5, until: 0.5, explicit: Explicit::Ahead, form: Form::Newton });
        s.extrapolate();
        s.settle(1.0);
    }
}
