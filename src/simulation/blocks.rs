//! Block time steps: with what they are compatible, the length of their criterion, and their clock.

use super::{Setup, Simulation};
use crate::error::Error;
use crate::kernel::{Array, BLOCK_CLOCK, BLOCK_CLOCK_START, BLOCK_CLOCK_WORDS, Backend, BlockSteps, STEP_LEVEL};
use crate::motion::Hold;

/// The column of softenings of particles.
const OWN_LENGTH: &str = "softening_length";

/// Particles of so many times the mean mass take the shortest step: at most one in so many does.
const HEAVY: f64 = 100.0;

/// The steps that particles have had.
#[derive(Debug, Clone, PartialEq)]
pub struct Levels {
    /// The longest step \[time\].
    pub dt: f64,
    /// The number of particles of each level at present, from 0 on: their steps are dt / 2ˡ.
    pub particles: Vec<u64>,
    /// The number of parts into which steps were divided, each as long as the shortest step of any particle.
    pub parts: u64,
    /// The number of evaluations of a particle.
    pub evaluations: u64,
}

impl Levels {
    /// The largest level of any particle at present.
    #[must_use]
    pub fn finest(&self) -> usize {
        self.particles.iter().rposition(|count| *count > 0).unwrap_or(0)
    }
    /// The number of evaluations, over that of all particles in all parts.
    #[must_use]
    pub fn work(&self) -> f64 {
        let all: u64 = self.particles.iter().sum();
        self.evaluations as f64 / (self.parts as f64 * all as f64).max(1.0)
    }
}

impl Setup {
    /// The block time steps, with the length of their criterion; 0 where particles have their own.
    pub(super) fn block_steps(&self) -> Option<BlockSteps> {
        let steps = self.integrator.block_steps()?;
        let mean = self.state.mass().iter().sum::<f64>() / self.state.mass().len().max(1) as f64;
        let steps = if steps.mass == 0.0 { BlockSteps { mass: HEAVY * mean, ..steps } } else { steps };
        let own = self.forces.iter().flat_map(|force| force.columns()).any(|column| column.name == OWN_LENGTH);
        if steps.length > 0.0 || own {
            return Some(steps);
        }
        let softenings = self.forces.iter().filter_map(|force| force.properties().softening);
        let length = softenings.reduce(f64::min).unwrap_or(0.0);
        Some(BlockSteps { length, ..steps })
    }
    /// Refuses what block time steps are not compatible with.
    pub(super) fn serves_blocks(&self) -> Result<(), Error> {
        let (Some(given), Some(steps)) = (self.integrator.block_steps(), self.block_steps()) else { return Ok(()) };
        given.check(self.dt)?;
        steps.check(self.dt)?;
        let own = self.forces.iter().flat_map(|force| force.columns()).any(|column| column.name == OWN_LENGTH);
        if steps.length == 0.0 && !own {
            return Err(Error::Scene(
                "block time steps are at most √(2 η ε / |a|), and no force has a softening ε: give gravity a softening, or block_length, the \
                 distance over which forces change"
                    .to_owned(),
            ));
        }
        let refuse = |why: &str| {
            Err(Error::Scene(format!(
                "block time steps are for forces alone, and {why}; leave block_levels out, or that"
            )))
        };
        if self.state.has_inactive() || self.state.capacity.is_some() {
            return refuse("particles are spawned or removed here");
        }
        if self.state.held.iter().any(|held| held.by != Hold::Fixed) {
            return refuse("particles are moved along paths here");
        }
        if self.elastic().is_some() {
            return refuse("the box changes here");
        }
        let columns = self.columns()?;
        match columns.pairs().first() {
            Some(pair) => {
                refuse(&format!("the column `{}` has a rate by which all steps advance it", pair.column.name))
            }
            None => Ok(()),
        }
    }
}

impl<B: Backend> Simulation<B> {
    /// The levels of the particles' steps; `None` where all steps have the same length.
    ///
    /// # Errors
    /// Errors of reading.
    pub async fn levels(&mut self) -> Result<Option<Levels>, Error> {
        let Some(steps) = self.problem.block_steps else { return Ok(None) };
        let count = self.problem.capacity as usize;
        let read = self.backend.read(STEP_LEVEL.name, &Array::Uint(Vec::new()), count).await?;
        let Array::Uint(levels) = read else { return Ok(None) };
        let mut particles = vec![0; steps.levels as usize + 1];
        levels.iter().filter_map(|level| particles.get_mut(*level as usize).map(|n| *n += 1)).count();
        let words = self.block_clock().await?;
        let [.., parts, more_parts, evaluations, more_evaluations] = words;
        let both = |low: u32, high: u32| u64::from(high) << 32 | u64::from(low);
        let (parts, evaluations) = (both(parts, more_parts), both(evaluations, more_evaluations));
        Ok(Some(Levels { dt: self.dt, particles, parts, evaluations }))
    }
    async fn block_clock(&mut self) -> Result<[u32; BLOCK_CLOCK_WORDS], Error> {
        let read = self.backend.read(BLOCK_CLOCK.name, &Array::Uint(Vec::new()), BLOCK_CLOCK_WORDS).await?;
        let words = if let Array::Uint(words) = read { words.try_into().ok() } else { None };
        Ok(words.unwrap_or(BLOCK_CLOCK_START))
    }
    /// Checks whether forces have required a step shorter than the shortest.
    pub(super) async fn on_block_clock(&mut self) -> Result<(), Error> {
        let Some(steps) = self.problem.block_steps else { return Ok(()) };
        let [_, _, _, _, step, particle, level, ..] = self.block_clock().await?;
        if step == u32::MAX {
            return Ok(());
        }
        Err(Error::TooManyLevels {
            step: u64::from(step),
            particle: self.named(particle),
            wanted: self.dt / f64::from(1_u32 << level),
            least: self.dt / f64::from(steps.whole()),
            levels: steps.levels,
        })
    }
}
