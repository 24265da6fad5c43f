//! Block time steps: with what they are compatible, the length of their criterion, and their clock.

use super::{Setup, Simulation};
use crate::error::Error;
use crate::forces::{Component, Over};
use crate::kernel::{Array, BLOCK_CLOCK, BLOCK_CLOCK_START, BLOCK_CLOCK_WORDS, Backend, BlockSteps, STEP_LEVEL};
use crate::motion::Hold;
use crate::state::State;

/// The column of softenings of particles.
const OWN_LENGTH: &str = "softening_length";

/// Particles of so many times the median mass take the shortest step.
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

/// The steps with what they leave to the forces and the particles: the length of the criterion, 0 where particles have their own, and the mass
/// above which particles take the shortest step.
fn resolved(steps: BlockSteps, state: &State, forces: &[Box<dyn Component>]) -> BlockSteps {
    let softenings = forces.iter().filter_map(|force| force.properties().softening);
    let common = if have_own(forces) { 0.0 } else { softenings.reduce(f64::min).unwrap_or(0.0) };
    let length = if steps.length > 0.0 { steps.length } else { common };
    // As files and devices have them: a run that goes on has the same steps.
    #[expect(clippy::cast_possible_truncation, reason = "single precision")]
    let single = state.mass().iter().map(|mass| f64::from(*mass as f32)).filter(|mass| *mass > 0.0);
    let mut masses: Vec<f64> = single.collect();
    masses.sort_by(f64::total_cmp);
    let median = masses.get(masses.len() / 2).copied().unwrap_or(0.0);
    let mass = if steps.mass > 0.0 { steps.mass } else { HEAVY * median };
    BlockSteps { length, mass: mass.min(f64::from(f32::MAX)), ..steps }
}

/// Whether particles have softenings of their own.
fn have_own(forces: &[Box<dyn Component>]) -> bool {
    forces.iter().flat_map(|force| force.columns()).any(|column| column.name == OWN_LENGTH)
}

/// The reasons for which block time steps of `dt` are impossible for these particles and forces, each whole.
#[must_use]
pub fn refuses_blocks(given: BlockSteps, state: &State, forces: &[Box<dyn Component>], dt: f64) -> Vec<String> {
    let mut all = Vec::new();
    if let Err(why) = given.check() {
        return vec![why.to_string()];
    }
    let steps = resolved(given, state, forces);
    let own = have_own(forces) && steps.length == 0.0;
    let demand = steps.demand(dt, if own { 1.0 } else { steps.length });
    let single = f64::from(f32::MIN_POSITIVE)..=f64::from(f32::MAX);
    if steps.length == 0.0 && !own {
        all.push(
            "block time steps are at most √(2 η ε / |a|), and there is no gravity with a softening ε above 0: give each gravity one, or block_length, the \
             distance over which forces change"
                .to_owned(),
        );
    } else if !single.contains(&demand) {
        all.push(format!(
            "block time steps compare accelerations with 2 η ε / dt² = {:e}, which is out of the range of single precision: choose other units",
            1.0 / demand
        ));
    }
    let mut refuse = |why: String| {
        all.push(format!("block time steps are for forces alone, and {why}: leave that out, or block_levels"));
    };
    if state.has_inactive() || state.capacity.is_some() {
        refuse("particles are spawned or removed here".to_owned());
    }
    if state.held.iter().any(|held| held.by != Hold::Fixed) {
        refuse("particles are moved along paths here".to_owned());
    }
    for force in forces {
        let (name, properties) = (force.name(), force.properties());
        let columns = force.columns();
        if let Some(why) = properties.fixed_step {
            refuse(format!("{name} is for steps of equal length ({why})"));
        } else if properties.collides.is_some() {
            refuse(format!("{name} acts at the end of a step of all bodies"));
        } else if properties.constrains
            || properties.keeps_rods
            || properties.limits_links
            || properties.barostat.is_some()
        {
            refuse(format!("{name} changes positions or velocities other than by forces"));
        } else if let Some(column) = columns.iter().find(|column| column.is_advanced()) {
            refuse(format!("all steps advance the column `{}` of {name} by its rate", column.name));
        } else if force.laws().iter().any(|law| matches!(law.over, Over::List { .. })) {
            refuse(format!("{name} is over a neighbour list, which is kept over steps"));
        } else if let Some(word) = ["world.dt", "world.step"]
            .into_iter()
            .find(|word| force.laws().iter().any(|law| law.wgsl.text.contains(word)))
        {
            refuse(format!("{name} reads `{word}`, which is that of a part of the step"));
        }
    }
    for column in state.declared().filter(|column| column.is_advanced()) {
        refuse(format!("all steps advance the column `{}` by its rate", column.name));
    }
    all
}

impl Setup {
    /// The block time steps, with the length of their criterion.
    pub(super) fn block_steps(&self) -> Option<BlockSteps> {
        Some(resolved(self.integrator.block_steps()?, &self.state, &self.forces))
    }
    /// Refuses what block time steps are not compatible with.
    pub(super) fn serves_blocks(&self) -> Result<(), Error> {
        let Some(steps) = self.integrator.block_steps() else { return Ok(()) };
        match refuses_blocks(steps, &self.state, &self.forces, self.dt).into_iter().next() {
            Some(why) => Err(Error::Scene(why)),
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
