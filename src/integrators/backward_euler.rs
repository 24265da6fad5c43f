//! Backward Euler: v ← v + a(x, v) dt, x ← x + v dt, both with the new state. Damps modes that it cannot resolve, at any step. Laws without
//! a Jacobian are evaluated at the start of the step, as by symplectic Euler (Ascher, Ruuth & Wetton 1995).

use super::{Explicit, Form, Implicit, Integrator, Step};

/// `backward_euler`
#[derive(Clone)]
pub struct BackwardEuler;

impl Integrator for BackwardEuler {
    fn name(&self) -> &'static str {
        "backward_euler"
    }
    fn order(&self) -> u32 {
        1
    }
    fn is_implicit(&self) -> bool {
        true
    }
    fn damps_at_any_step(&self) -> bool {
        true
    }
    fn step(&self, s: &mut Step) {
        s.solve(Implicit { part: 1.0, until: 1.0, explicit: Explicit::Here, form: Form::Newton });
        s.settle(1.0);
    }
}
