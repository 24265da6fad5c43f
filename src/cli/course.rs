//! How far a run has come, in steps of dt. Where steps are adaptive, others come in between: then these are times that the
//! run stops at when something is to be written there.

use super::progress::plain;
use motes::kernel::{Backend, Reason};
use motes::scene::Scene;
use motes::simulation::Clock;
use motes::{Error, Simulation, State};
use serde_json::{Value, json};

/// `1000 steps of 0.001`, for people.
pub fn words(scene: &Scene) -> String {
    match scene.adaptive_step {
        Some(adaptive_step) => {
            format!("{} of time in steps of {} to {}", plain(scene.until), plain(adaptive_step.least), plain(scene.dt))
        }
        None => format!("{} of {}", steps(scene.steps), plain(scene.dt)),
    }
}

/// `1 step`, `2 steps`.
pub fn steps(count: u64) -> String {
    if count == 1 { "1 step".to_owned() } else { format!("{count} steps") }
}

/// Steps of dt that a time is past.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "below 2³² steps, or saturated")]
fn whole(time: f64, dt: f64) -> u64 {
    (time / dt) as u64
}

/// Steps of dt after which a run of a scene begins, from this state.
pub fn begun(scene: &Scene, state: &State) -> u64 {
    if scene.adaptive_step.is_some() { whole(state.time, scene.dt) } else { state.step }
}

/// The way to the end.
pub struct Course {
    dt: f64,
    until: f64,
    steps: u64,
    done: u64,
    /// What the clock said last, where there is one, and where it stops next: the step of dt, and the time.
    clock: Option<(Clock, u64, f64)>,
}

impl Course {
    /// The course of a scene, where its simulation begins.
    pub async fn of<B: Backend>(scene: &Scene, simulation: &mut Simulation<B>) -> Result<Self, Error> {
        let clock = simulation.clock().await?;
        let done = clock.map_or(simulation.steps(), |clock| whole(clock.time, scene.dt));
        let clock = clock.map(|clock| (clock, done, 0.0));
        Ok(Self { dt: scene.dt, until: scene.until, steps: scene.steps, done, clock })
    }
    /// Steps of dt that are done.
    pub fn done(&self) -> u64 {
        self.done
    }
    /// Goes on, at most to `target` and by at most so many steps, and looks whether all is well. Gives how many it was.
    pub async fn advance<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        target: u64,
        most: u64,
    ) -> Result<u64, Error> {
        let Some((clock, stop, time)) = &mut self.clock else {
            let some = u32::try_from((target - self.done).min(most)).unwrap_or(u32::MAX);
            simulation.step(some)?;
            // Looking waits for the batch, and finds what broke in it.
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
    pub fn clock(&self) -> Option<&Clock> {
        self.clock.as_ref().map(|(clock, ..)| clock)
    }
    /// How long steps were, and why.
    pub fn summary(&self) -> Option<String> {
        let clock = self.clock()?;
        let [shortest, longest] = clock.between;
        let all = clock.steps.max(1) as f64;
        let some = |(reason, n): (&Reason, &u32)| {
            (*n > 0).then(|| format!("{} {:.1} %", reason.name(), 100.0 * f64::from(*n) / all))
        };
        let reasons: Vec<_> = Reason::ALL.iter().zip(&clock.reasons).filter_map(some).collect();
        Some(format!(
            "adaptive steps: {} from {shortest:.3e} to {longest:.3e}, {:.3e} in the mean; limited by {}; to go on from \
             here, set dt_before = {:.4e}",
            clock.steps,
            clock.mean(),
            reasons.join(", "),
            clock.free
        ))
    }
    /// The same for programs.
    pub fn event(&self) -> Value {
        self.clock().map_or(Value::Null, |clock| {
            let reasons: serde_json::Map<_, _> =
                Reason::ALL.iter().zip(&clock.reasons).map(|(reason, n)| (reason.name().to_owned(), json!(n))).collect();
            json!({ "steps": clock.steps, "shortest": clock.between[0], "longest": clock.between[1], "mean": clock.mean(),
                "reasons": reasons, "next": clock.free })
        })
    }
}
