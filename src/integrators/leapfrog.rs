//! Leapfrog, kick-drift-kick (velocity Verlet; Verlet 1967): one evaluation per step, because the last kick of a step
//! and the first of the next share theirs.

use super::{Integrator, Step};

/// `leapfrog`
#[derive(Clone)]
pub struct Leapfrog;

impl Integrator for Leapfrog {
    fn name(&self) -> &'static str {
        "leapfrog"
    }
    fn order(&self) -> u32 {
        2
    }
    fn ends_with_forces(&self) -> bool {
        true
    }
    fn is_symplectic(&self) -> bool {
        true
    }
    fn start(&self, s: &mut Step) {
        s.evaluate();
    }
    fn step(&self, s: &mut Step) {
        s.kick(0.5);
        s.drift(1.0);
        s.at(1.0);
        s.evaluate();
        s.kick(0.5);
    }
}
