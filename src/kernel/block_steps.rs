//! Block time steps: a step is divided in halves, each of these again, and so on; a particle takes one of these lengths, whichever its
//! acceleration allows, and is kicked at the ends of its own steps alone.

use super::Field;
use crate::error::Error;

/// The steps of particles: dt / 2ˡ, with the least level l that obeys √(2 η ε / |a|) (Springel 2005).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BlockSteps {
    /// The largest level, from 1 to [`MOST_LEVELS`]: the shortest step is dt / 2^levels, and a run ends where forces require a shorter one.
    pub levels: u32,
    /// η of the criterion.
    pub eta: f64,
    /// ε of the criterion \[length\]; 0: the softening of the forces.
    pub length: f64,
    /// Particles that are heavier take the shortest step of any \[mass\]; 0: than a hundred times the median. A heavy body among light ones has a
    /// small acceleration, and it is the sum of many forces that change quickly.
    pub mass: f64,
    /// Whether all particles take the shortest step of any.
    pub shared: bool,
}

/// The largest level there may be.
pub const MOST_LEVELS: u32 = 10;
/// The level of a particle's steps.
pub const STEP_LEVEL: Field<u32> = Field::new("step_level");
/// One word for each particle: 1 where its own step ends with the present part of the step, so that its acceleration is needed.
pub const DUE: Field<u32> = Field::new("due");
/// The clock of a step's parts, in parts of dt / 2^levels. 0: where the present part begins; 1: where it ends; 2: 1 if that is the end of
/// the step; 3: the largest level of any particle. 4 to 6: the first step in which a particle required a larger level than there is, the
/// lowest id of such a particle, and the largest level required; [`u32::MAX`] in the first two while there is none. 7 and 8: the number of
/// parts so far, the lower word first; 9 and 10: that of evaluations of a particle.
pub const BLOCK_CLOCK: Field<u32> = Field::new("block_clock");
/// The words of the clock.
pub const BLOCK_CLOCK_WORDS: usize = 11;
/// The clock at the start of a run.
pub const BLOCK_CLOCK_START: [u32; BLOCK_CLOCK_WORDS] = [0, 0, 0, 0, u32::MAX, u32::MAX, 0, 0, 0, 0, 0];

impl BlockSteps {
    /// Checks the numbers.
    ///
    /// # Errors
    /// [`Error::Scene`] with the invalid number.
    pub fn check(&self) -> Result<(), Error> {
        let Self { levels, eta, length, mass, .. } = *self;
        if !(1..=MOST_LEVELS).contains(&levels) {
            return Err(Error::Scene(format!(
                "block steps have {levels} levels: choose 1 to {MOST_LEVELS}, for a shortest step of dt / 2 to dt / {}",
                1 << MOST_LEVELS
            )));
        }
        if !(eta > 0.0 && eta.is_finite()) {
            return Err(Error::Scene(format!("the η of block steps is {eta}: choose one above 0; 0.025 is usual")));
        }
        if !(length >= 0.0 && length.is_finite()) {
            return Err(Error::Scene(format!("the length of block steps is {length}: choose one above 0")));
        }
        if !(mass >= 0.0 && mass.is_finite()) {
            return Err(Error::Scene(format!("the mass of block steps is {mass}: choose one above 0")));
        }
        Ok(())
    }
    /// The number of shortest steps in the longest.
    #[must_use]
    pub fn whole(&self) -> u32 {
        1 << self.levels
    }
    /// dt² / (2 η ε): times an acceleration, the square of the number of steps in dt that it requires.
    #[must_use]
    pub fn demand(&self, dt: f64, length: f64) -> f64 {
        dt * dt / (2.0 * self.eta * length)
    }
}
