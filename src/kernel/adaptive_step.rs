//! Adaptive time steps. The clock counts in whole ticks, 2²⁴ in the longest step: sums of them are exact, so that no rounding error
//! accumulates over a run, and an end time is reached to the tick.

use super::{Field, Host, Problem, Source};
use crate::error::Error;

/// Steps as short as forces require, and no longer than `dt`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AdaptiveStep {
    /// The shortest step \[time\]: a run ends where forces require a shorter one.
    pub least: f64,
    /// The Courant number C, a factor of every dt criterion of forces.
    pub courant: f64,
    /// The length of the step before the first, after which steps grow by a fifth at most \[time\]; `None`: the first is limited by forces
    /// alone.
    pub before: Option<f64>,
}

/// Ticks in the longest step.
pub const TICKS: u32 = 1 << 24;
/// The shortest step, as a part of the longest, at least: ticks must distinguish steps.
pub const LEAST_PART: f64 = 1e-6;

/// The clock, word by word: 0 and 1: the time in longest steps and ticks; 2: the ticks of the current step, 0 where the run has stopped; 3:
/// those of the last step that was limited only by forces and growth; 4: the reason, a [`Reason`]; 5: the limiting particle, the lowest id
/// of those whose criterion gave it. 6 to 9: the first step that should have been shorter than the shortest, its reason, its particle, and
/// the number of such steps in a longest one, as the bits of an `f32`; [`u32::MAX`] while there is none. 10 and 11: the ticks of the
/// shortest and of the longest step so far; from 12 on the number of steps with each reason.
pub const STEP_CLOCK: Field<u32> = Field::new("step_clock");
/// The words of the clock.
pub const STEP_CLOCK_WORDS: usize = 12 + Reason::ALL.len();
/// The time at which the clock stops, in longest steps and ticks.
pub const STOP: Field<u32> = Field::new("step_clock_stop");
/// The dt criteria: the number of steps per longest step that each particle requires, for acceleration, signal and speed.
pub const STEP_CRITERIA: Field<glam::Vec4> = Field::new("step_criteria");
/// The largest of [`STEP_CRITERIA`].
pub const LARGEST_CRITERION: Field<glam::Vec4> = Field::new("largest_criterion");

/// The reason for the length of a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reason {
    /// It is the longest that is allowed.
    Longest,
    /// The acceleration criterion.
    Acceleration,
    /// The signal criterion: the speed of sound, and the speed at which particles approach.
    Signal,
    /// The viscosity criterion.
    Viscosity,
    /// The speed criterion.
    Speed,
    /// The step before it was shorter.
    Growth,
    /// The run stops there.
    Stop,
    /// The integrator's estimate of its own error.
    Error,
}

impl Reason {
    /// All reasons, in the order of their numbers on a device.
    pub const ALL: [Self; 8] = [
        Self::Longest,
        Self::Acceleration,
        Self::Signal,
        Self::Viscosity,
        Self::Speed,
        Self::Growth,
        Self::Stop,
        Self::Error,
    ];
    /// The reason of a number.
    #[must_use]
    pub fn of(number: u32) -> Self {
        Self::ALL.get(number as usize).copied().unwrap_or(Self::Longest)
    }
    /// What allows longer steps, where it requires too short ones.
    #[must_use]
    pub fn remedy(self) -> &'static str {
        match self {
            Self::Error => {
                "look for bodies that start too close to each other, and for forces that jump, as at a cut-off or over a tree; rounding counts in \
                 single precision (choose precision = \"double_single\"), and where `tolerance` is small; or choose a smaller dt and dt_min"
            }
            _ => "look for particles that start too close to each other or to a wall, or set a smaller dt_min",
        }
    }
    /// Its name, one word, for tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Longest => "longest",
            Self::Acceleration => "acceleration",
            Self::Signal => "signal",
            Self::Viscosity => "viscosity",
            Self::Speed => "speed",
            Self::Growth => "growth",
            Self::Stop => "stop",
            Self::Error => "error",
        }
    }
}

/// The ticks of a length of time, in steps of `dt`, rounded to the nearest.
#[must_use]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to 32 bits")]
pub fn ticks(time: f64, dt: f64) -> u32 {
    (time / dt * f64::from(TICKS)).round().clamp(0.0, f64::from(u32::MAX)) as u32
}

/// A time in longest steps of `dt`, and ticks.
#[must_use]
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to what 32 bits hold")]
pub fn split(time: f64, dt: f64) -> [u32; 2] {
    let all = (time / dt * f64::from(TICKS)).round().max(0.0);
    let whole = (all / f64::from(TICKS)).floor();
    if whole >= f64::from(u32::MAX) {
        return [u32::MAX, 0];
    }
    [whole as u32, (all - whole * f64::from(TICKS)) as u32]
}

impl AdaptiveStep {
    /// Checks whether such steps, none longer than `dt`, are possible.
    ///
    /// # Errors
    /// [`Error::Scene`] with the invalid number.
    pub fn check(&self, dt: f64) -> Result<(), Error> {
        let Self { least, courant, before } = *self;
        if !(LEAST_PART * dt..=dt).contains(&least) {
            return Err(Error::Scene(format!(
                "the shortest step is {least:e} and the longest {dt:e}: choose a shortest step between {:e} and the longest",
                LEAST_PART * dt
            )));
        }
        if !(courant > 0.0 && courant <= 1.0) {
            return Err(Error::Scene(format!(
                "the Courant number is {courant}: choose one above 0, at most 1; 0.25 is usual"
            )));
        }
        if let Some(before) = before.filter(|before| !(least..=dt).contains(before)) {
            return Err(Error::Scene(format!(
                "the step before the first is {before:e}: it must be between the shortest, {least:e}, and the longest, {dt:e}"
            )));
        }
        Ok(())
    }
    /// The words of a clock at time zero.
    #[must_use]
    pub fn start(&self, dt: f64) -> Vec<u32> {
        let mut words = vec![0; STEP_CLOCK_WORDS];
        words[3] = self.before.map_or(TICKS, |before| ticks(before, dt));
        words[5..10].fill(u32::MAX);
        words[4] = 0;
        words[10] = u32::MAX;
        words
    }
}

/// The time after a part of the step, for a reference.
///
/// # Errors
/// When there is no clock.
pub fn time(host: &Host, problem: &Problem, part: f64) -> Result<f64, Error> {
    let world = host.world();
    if problem.adaptive_step.is_none() {
        return Ok((f64::from(world.step) + part) * world.dt);
    }
    let [whole, rest, step] = host.read(STEP_CLOCK)?.first_chunk().copied().unwrap_or_default();
    Ok((f64::from(whole) + (f64::from(rest) + part * f64::from(step)) / f64::from(TICKS)) * problem.dt)
}

impl Problem {
    /// The same problem with adaptive steps.
    #[must_use]
    pub fn adapted(self, adaptive_step: Option<AdaptiveStep>) -> Self {
        Self { adaptive_step, ..self }
    }
    /// The file that gives motions the time after a part of the step.
    #[must_use]
    pub fn clock(&self) -> Source {
        if self.adaptive_step.is_some() {
            crate::shader!("motion/adaptive.wgsl")
        } else {
            crate::shader!("motion/even.wgsl")
        }
    }
    /// The constants of that file.
    #[must_use]
    pub fn clock_constants(&self) -> Vec<(&'static str, f64)> {
        if self.adaptive_step.is_some() { vec![("UNIT", self.dt)] } else { Vec::new() }
    }
    /// The number of elements of the clock, where there is one.
    #[must_use]
    pub fn clock_sizes(&self) -> Vec<(super::Name, u64)> {
        if self.adaptive_step.is_some() { vec![(STEP_CLOCK.name.into(), STEP_CLOCK_WORDS as u64)] } else { Vec::new() }
    }
}
