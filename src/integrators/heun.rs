//! Heun's method (1900), a Runge–Kutta method of order 2: the mean of the slopes at both ends, by the trapezoid rule.

use super::{Integrator, Step};

/// `heun`
#[derive(Clone)]
pub struct Heun;

impl Integrator for Heun {
    fn name(&self) -> &'static str {
        "heun"
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
        s.stage(0.5, 1.0);
        s.at(1.0);
        s.evaluate();
        s.finish(0.5);
    }
}
