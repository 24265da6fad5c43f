//! Euler's method (1768): x ← x + v dt, v ← v + a(x) dt, both from the old state. Gains energy at every step.

use super::{Integrator, Step};

/// `forward_euler`
#[derive(Clone)]
pub struct ForwardEuler;

impl Integrator for ForwardEuler {
    fn name(&self) -> &'static str {
        "forward_euler"
    }
    fn order(&self) -> u32 {
        1
    }
    fn step(&self, s: &mut Step) {
        s.evaluate();
        s.drift(1.0);
        s.kick(1.0);
    }
}
