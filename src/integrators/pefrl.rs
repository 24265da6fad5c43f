//! Position-extended Forest–Ruth-like, symplectic, order 4 (Omelyan, Mryglod & Folk 2002, eq. 22): one evaluation more
//! than Forest–Ruth. On an oscillator its error of phase is about a thousand times smaller, on an orbit of eccentricity ½
//! the error of position at least ten times.

use super::{Integrator, Step};

/// `pefrl`
#[derive(Clone)]
pub struct Pefrl;

const XI: f64 = 0.178_617_895_844_809_1;
const LAMBDA: f64 = -0.212_341_831_062_605_4;
const CHI: f64 = -0.066_264_582_669_818_5;

impl Integrator for Pefrl {
    fn name(&self) -> &'static str {
        "pefrl"
    }
    fn order(&self) -> u32 {
        4
    }
    fn is_symplectic(&self) -> bool {
        true
    }
    fn step(&self, s: &mut Step) {
        s.drift(XI);
        s.at(XI);
        s.evaluate();
        s.kick(0.5 - LAMBDA);
        s.drift(CHI);
        s.at(XI + CHI);
        s.evaluate();
        s.kick(LAMBDA);
        s.drift(1.0 - 2.0 * (CHI + XI));
        s.at(1.0 - (XI + CHI));
        s.evaluate();
        s.kick(LAMBDA);
        s.drift(CHI);
        s.at(1.0 - XI);
        s.evaluate();
        s.kick(0.5 - LAMBDA);
        s.drift(XI);
    }
}
