//! The trapezoid rule (Crank & Nicolson 1947): half a step by Euler's method, then half a step by the implicit one.

use super::{Explicit, Form, Implicit, Integrator, Step};

/// `trapezoid`
#[derive(Clone)]
pub struct Trapezoid;

impl Integrator for Trapezoid {
    fn name(&self) -> &'static str {
        "trapezoid"
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
        s.solve(Implicit { part: 0.5, until: 1.0, explicit: Explicit::Ahead, form: Form::Newton });
        s.settle(0.5);
    }
}
