//! The classical Runge–Kutta method of order 4 (Kutta 1901).

use super::{Integrator, Step};

/// `rk4`
#[derive(Clone)]
pub struct RungeKutta4;

impl Integrator for RungeKutta4 {
    fn name(&self) -> &'static str {
        "rk4"
    }
    fn order(&self) -> u32 {
        4
    }
    fn order_with_velocity(&self) -> u32 {
        4
    }
    fn step(&self, s: &mut Step) {
        s.save();
        s.evaluate();
        s.stage(1.0 / 6.0, 0.5);
        s.at(0.5);
        s.evaluate();
        s.stage(1.0 / 3.0, 0.5);
        s.evaluate();
        s.stage(1.0 / 3.0, 1.0);
        s.at(1.0);
        s.evaluate();
        s.finish(1.0 / 6.0);
    }
}
