//! The symplectic Euler method, kick before drift (de Vogelaere 1956): v ← v + a(x) dt, x ← x + v dt.

use super::{Integrator, Step};

/// `symplectic_euler`
#[derive(Clone)]
pub struct SymplecticEuler;

impl Integrator for SymplecticEuler {
    fn name(&self) -> &'static str {
        "symplectic_euler"
    }
    fn order(&self) -> u32 {
        1
    }
    fn is_symplectic(&self) -> bool {
        true
    }
    fn step(&self, s: &mut Step) {
        s.evaluate();
        s.kick(1.0);
        s.drift(1.0);
    }
}
