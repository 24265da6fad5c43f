//! The progress of a run, in steps of dt. With adaptive steps, other steps lie in between: then these are times at which the run stops to
//! write output.

use crate::error::Error;
use crate::kernel::Backend;
use crate::scene::Scene;
use crate::simulation::{Clock, Simulation};
use crate::state::State;

/// The number of whole steps of dt up to a time.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below 2³² steps, or saturated")]
fn whole(time: f64, dt: f64) -> u64 {
    (time / dt) as u64
}

/// The number of steps of dt before a run of a scene begins, from this state.
#[must_use]
pub fn begun(scene: &Scene, state: &State) -> u64 {
    if scene.adaptive_step.is_some() { whole(state.time, scene.dt) } else { state.step }
}

/// The progress of a run.
#[derive(Debug)]
pub struct Course {
    dt: f64,
    until: f64,
    steps: u64,
    done: u64,
    /// The last clock read, if there is one, and the next stop: the step of dt, and the time.
    clock: Option<(Clock, u64, f64)>,
}

impl Course {
    /// The course of a scene, at the start of its simulation.
    pub(super) async fn of<B: Backend>(scene: &Scene, simulation: &mut Simulation<B>) -> Result<Self, Error> {
        let clock = simulation.clock().await?;
        let done = clock.map_or(simulation.steps(), |clock| whole(clock.time, scene.dt));
        let clock = clock.map(|clock| (clock, done, 0.0));
        Ok(Self { dt: scene.dt, until: scene.until, steps: scene.steps, done, clock })
    }
    /// Continues after `done` steps of dt: the clock alone may differ from them by rounding.
    pub(super) fn go_on(&mut self, done: u64) {
        self.done = done;
    }
    /// The number of steps of dt done.
    #[must_use]
    pub fn done(&self) -> u64 {
        self.done
    }
    /// Advances at most to `target` and by at most `most` steps, and checks for failures. Returns the number of steps.
    pub(super) async fn advance<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        target: u64,
        most: u64,
    ) -> Result<u64, Error> {
        let Some((clock, stop, time)) = &mut self.clock else {
            let some = u32::try_from((target - self.done).min(most)).unwrap_or(u32::MAX);
            simulation.step(some)?;
            // The check waits for the batch, and finds its failures.
            simulation.check().await?;
            self.done = simulation.steps();
            return Ok(some.into());
        };
        if *stop != target {
            let end = if target == self.steps { self.until } else { target as f64 * self.dt };
            (*stop, *time) = (target, simulation.stop_at(end)?);
        }
        let some = clock.steps_before(*time, self.dt).min(u32::try_from(most).unwrap_or(u32::MAX)).max(1);
        simulation.step(some)?;
        simulation.check().await?;
        if let Some(now) = simulation.clock().await? {
            *clock = now;
        }
        self.done = if clock.time >= *time { target } else { whole(clock.time, self.dt).clamp(self.done, target - 1) };
        Ok(some.into())
    }
    /// The clock, where there is one.
    #[must_use]
    pub fn clock(&self) -> Option<&Clock> {
        self.clock.as_ref().map(|(clock, ..)| clock)
    }
    /// The present time.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.clock().map_or(self.done as f64 * self.dt, |clock| clock.time)
    }
}
