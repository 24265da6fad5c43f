//! Backward Euler by one linear solve, of forces linearized about the start of the step (Baraff & Witkin 1998).

use super::{Explicit, Form, Implicit, Integrator, Step};

/// `linear_backward_euler`
#[derive(Clone)]
pub struct LinearBackwardEuler;

impl Integrator for LinearBackwardEuler {
    fn name(&self) -> &'static str {
        "linear_backward_euler"
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
        s.solve(Implicit { part: 1.0, until: 1.0, explicit: Explicit::Here, form: Form::Linear });
        s.settle(1.0);
    }
}
