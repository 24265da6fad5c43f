//! The symplectic method of order 4 by Forest & Ruth (1990), which is Yoshida's (1990) triple jump.

use super::{Integrator, Step};

/// `forest_ruth`
#[derive(Clone)]
pub struct ForestRuth;

/// θ = 1 / (2 − ∛2)
const THETA: f64 = 1.351_207_191_959_657_6;

impl Integrator for ForestRuth {
    fn name(&self) -> &'static str {
        "forest_ruth"
    }
    fn order(&self) -> u32 {
        4
    }
    fn is_symplectic(&self) -> bool {
        true
    }
    fn step(&self, s: &mut Step) {
        s.drift(THETA / 2.0);
        s.at(THETA / 2.0);
        s.evaluate();
        s.kick(THETA);
        s.drift((1.0 - THETA) / 2.0);
        s.at(0.5);
        s.evaluate();
        s.kick(1.0 - 2.0 * THETA);
        s.drift((1.0 - THETA) / 2.0);
        s.at(1.0 - THETA / 2.0);
        s.evaluate();
        s.kick(THETA);
        s.drift(THETA / 2.0);
    }
}
