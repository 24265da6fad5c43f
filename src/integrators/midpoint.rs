//! The midpoint rule (Runge 1895), a Runge–Kutta method of order 2: the slope in the middle of the step is used for all of it.

use super::{Integrator, Step};

/// `midpoint`
#[derive(Clone)]
pub struct Midpoint;

impl Integrator for Midpoint {
    fn name(&self) -> &'static str {
        "midpoint"
    }
    fn order(&self) -> u32 {
        2
    }
    fn order_with_velocity(&self) -> u32 {
        2
    }
    fn step(&self, s: &mut Step) {
        s.save();
        s.evaluate();
        s.stage(0.0, 0.5);
        s.at(0.5);
        s.evaluate();
        s.finish(1.0);
    }
}
