//! Leapfrog in block time steps (Hernquist & Katz 1989; Springel 2005): each particle is kicked at the ends of steps of its own, dt / 2ˡ,
//! and all drift together. With all particles on one level it is leapfrog with that step, to the bit. A particle's forces are evaluated at
//! the ends of its own steps alone, so that the two of a pair are kicked at different times: momentum is conserved only as well as
//! trajectories are, and so is energy, since steps that change are not symplectic.

use super::{Integrator, Step};
use crate::kernel::{BlockSteps, Column, Kind, STEP_LEVEL};

/// Leapfrog in block time steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlockLeapfrog(pub BlockSteps);

impl Integrator for BlockLeapfrog {
    fn name(&self) -> &'static str {
        "leapfrog in block time steps"
    }
    fn order(&self) -> u32 {
        2
    }
    fn ends_with_forces(&self) -> bool {
        true
    }
    fn block_steps(&self) -> Option<BlockSteps> {
        Some(self.0)
    }
    fn columns(&self) -> Vec<Column> {
        let about = "the level l of its time steps, which are dt / 2ˡ long";
        vec![Column::new(STEP_LEVEL.name, Kind::Whole, "", about)]
    }
    fn start(&self, s: &mut Step) {
        s.evaluate();
    }
    fn step(&self, s: &mut Step) {
        s.block_steps();
    }
}
