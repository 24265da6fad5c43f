//! The clock of adaptive steps.

use super::Simulation;
use crate::error::Error;
use crate::forces::Component;
use crate::kernel::{Array, Backend, Bounds, Reason, STEP_CLOCK, STEP_CLOCK_WORDS, STOP, Side, TICKS, split};
use crate::motion::Hold;
use crate::state::State;

/// The state and the statistics of a clock.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Clock {
    /// Steps done.
    pub steps: u64,
    /// The time.
    pub time: f64,
    /// The length of the last step \[time\]; 0 where the run rests, because its stop is reached.
    pub dt: f64,
    /// The reason that limits its length.
    pub reason: Reason,
    /// The limiting particle: the lowest id of those whose criterion gave it, where there is one.
    pub particle: Option<u32>,
    /// The shortest and the longest step so far \[time\].
    pub between: [f64; 2],
    /// The number of steps with each reason, in the order of [`Reason::ALL`].
    pub reasons: [u32; Reason::ALL.len()],
    /// The length of a step that continues from here, if it is given to [`AdaptiveStep::before`](crate::kernel::AdaptiveStep::before) \[time\].
    pub free: f64,
}

impl Clock {
    /// The mean length of a step \[time\].
    #[must_use]
    pub fn mean(&self) -> f64 {
        self.time / self.steps.max(1) as f64
    }
    fn of(words: &[u32; STEP_CLOCK_WORDS], longest: f64) -> Self {
        let length = |ticks: u32| f64::from(ticks) / f64::from(TICKS) * longest;
        let mut reasons = [0; Reason::ALL.len()];
        reasons.copy_from_slice(&words[12..]);
        Self {
            steps: reasons.iter().map(|n| u64::from(*n)).sum(),
            time: time_of(words, longest),
            dt: length(words[2]),
            reason: Reason::of(words[4]),
            particle: Some(words[5]).filter(|id| *id < u32::MAX),
            between: if words[11] > 0 { [length(words[10]), length(words[11])] } else { [0.0; 2] },
            reasons,
            free: length(words[3]),
        }
    }
    /// A number of steps, at least one, that cannot pass the time `stop`: no step is longer than `longest`, or more than a fifth longer
    /// than the one before it.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of steps, capped")]
    pub fn steps_before(&self, stop: f64, longest: f64) -> u32 {
        let (mut left, mut step, mut count) = (stop - self.time, self.free, 0u32);
        loop {
            step = (1.2 * step).min(longest);
            if step >= longest {
                return (f64::from(count) + (left / longest).floor()).clamp(1.0, 1e6) as u32;
            }
            left -= step;
            if left < 0.0 {
                return count.max(1);
            }
            count += 1;
        }
    }
}

/// The reason for which an integrator cannot choose its steps by the error of forces: something acts at the ends of steps alone.
#[must_use]
pub fn refuses_own_steps(state: &State, forces: &[Box<dyn Component>], bounds: &Bounds) -> Option<String> {
    let acts = forces.iter().find(|force| {
        let properties = force.properties();
        properties.constrains || properties.keeps_rods || properties.limits_links
    });
    let what = if state.held.iter().any(|held| held.by != Hold::Fixed) {
        "particles are moved along paths".to_owned()
    } else if bounds.has(Side::Reflecting) {
        "the box has reflecting sides".to_owned()
    } else {
        format!("`{}` does", acts?.name())
    };
    Some(format!(
        "the error of forces, by which steps are chosen, says nothing of what acts at the ends of steps alone, and {what}: choose leapfrog and a fixed dt"
    ))
}

/// The time of a clock.
fn time_of(words: &[u32], longest: f64) -> f64 {
    let part = |place: usize| words.get(place).copied().map_or(0.0, f64::from);
    (part(0) + part(1) / f64::from(TICKS)) * longest
}

impl<B: Backend> Simulation<B> {
    /// The clock of the run; `None` where all steps have the same length.
    ///
    /// # Errors
    /// Errors of reading.
    pub async fn clock(&mut self) -> Result<Option<Clock>, Error> {
        self.settle().await?;
        self.clock_now().await
    }
    /// Like [`Self::clock`], whether or not the list had enough capacity.
    pub(super) async fn clock_now(&mut self) -> Result<Option<Clock>, Error> {
        let Some(words) = self.words().await? else { return Ok(None) };
        let mut clock = Clock::of(&words, self.dt);
        clock.particle = clock.particle.map(|row| self.named(row));
        self.steps = clock.steps;
        Ok(Some(clock))
    }
    /// Sets the time at which the run stops: the last step before it is shortened, and later steps move no particle until another stop is
    /// set (forces are evaluated again in them, at zero velocities, which changes quantities that depend on velocity: to avoid this, run no
    /// such steps). The stop is met to 2⁻²⁵ of the longest step; the time that is reached is returned.
    ///
    /// # Errors
    /// [`Error::Scene`] where all steps have the same length, or the time is too far away.
    pub fn stop_at(&mut self, time: f64) -> Result<f64, Error> {
        if self.adaptive_step.is_none() {
            return Err(Error::Scene(
                "a stop time requires adaptive steps, and this simulation has a fixed dt: choose adaptive steps"
                    .to_owned(),
            ));
        }
        let words = split(time, self.dt);
        if words[0] == u32::MAX || !time.is_finite() {
            return Err(Error::Scene(format!(
                "a stop at {time:e} is more than {} steps of {:e} away",
                u32::MAX,
                self.dt
            )));
        }
        self.unrepeatable();
        self.backend.write(STOP.name, &Array::Uint(words.to_vec()))?;
        Ok(time_of(&words, self.dt))
    }
    async fn words(&mut self) -> Result<Option<[u32; STEP_CLOCK_WORDS]>, Error> {
        if self.adaptive_step.is_none() {
            return Ok(None);
        }
        let words = self.backend.read(STEP_CLOCK.name, &Array::Uint(Vec::new()), STEP_CLOCK_WORDS).await?;
        let Array::Uint(words) = words else { return Ok(None) };
        Ok(words.try_into().ok())
    }
    /// Removes the stop, where steps are adaptive.
    pub(super) fn unstop(&mut self) -> Result<(), Error> {
        if self.adaptive_step.is_none() {
            return Ok(());
        }
        self.backend.write(STOP.name, &Array::Uint(vec![u32::MAX, 0]))
    }
    /// Checks whether forces have required a step shorter than the shortest.
    pub(super) async fn on_step_clock(&mut self) -> Result<(), Error> {
        let (Some(words), Some(adaptive_step)) = (self.words().await?, self.adaptive_step) else { return Ok(()) };
        self.steps = Clock::of(&words, self.dt).steps;
        if words[6] == u32::MAX {
            return Ok(());
        }
        let particle = if words[8] == u32::MAX {
            "all particles".to_owned()
        } else {
            format!("particle {}", self.named(words[8]))
        };
        Err(Error::TooShort {
            step: u64::from(words[6]),
            wanted: self.dt / f64::from(f32::from_bits(words[9])),
            least: adaptive_step.least,
            reason: Reason::of(words[7]).name(),
            particle,
            remedy: Reason::of(words[7]).remedy(),
        })
    }
}
