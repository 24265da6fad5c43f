//! How many steps a frame takes, so that it stays short.

use web_time::{Duration, Instant};

/// The time of a frame that steps may take.
const BUDGET: Duration = Duration::from_millis(12);
/// Steps in a second at the start.
const RATE: f64 = 60.0;
/// The part by which a measured time replaces the mean.
const FOLLOW: f64 = 0.2;
/// The time since the last frame for which steps are due, at most \[seconds\].
const LONGEST: f64 = 0.25;
/// Steps in a frame, at most.
const MOST: u32 = 4096;

/// The pace of a run.
pub struct Pace {
    dt: f64,
    /// The steps in a second that are wanted.
    pub wanted: f64,
    /// The mean times of a step and of a picture \[seconds\].
    pub step: Option<f64>,
    pub picture: Option<f64>,
    last: Option<Instant>,
    /// The part of a step that is due.
    due: f64,
    /// Steps in a second, as they are.
    pub rate: f64,
    /// Steps in every frame, where their number does not depend on time.
    pub fixed: Option<u32>,
}

impl Pace {
    pub fn new(dt: f64) -> Self {
        Self { dt, wanted: RATE, step: None, picture: None, last: None, due: 0.0, rate: 0.0, fixed: None }
    }
    /// Simulated time in a second, as wanted and as it is.
    pub fn speeds(&self) -> [f64; 2] {
        [self.wanted, self.rate].map(|rate| rate * self.dt)
    }
    pub fn faster(&mut self, factor: f64) {
        self.wanted = (self.wanted * factor).clamp(0.1, 1e6);
    }
    /// The steps of the next frame: as many as are due, or as fit its time. What is missing is not made up for.
    pub fn steps(&mut self) -> u32 {
        let now = Instant::now();
        let passed = self.last.map_or(0.0, |last| (now - last).as_secs_f64());
        self.last = Some(now);
        let steps = self.fixed.unwrap_or_else(|| self.count(passed.min(LONGEST)));
        self.passed(steps, passed);
        steps
    }
    /// So many steps were made in so many seconds.
    fn passed(&mut self, steps: u32, seconds: f64) {
        if seconds > 0.0 {
            self.rate += FOLLOW * (f64::from(steps) / seconds - self.rate);
        }
    }
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a number of steps, which is bounded")]
    fn count(&mut self, passed: f64) -> u32 {
        let fit = self.step.map_or(1.0, |step| (BUDGET.as_secs_f64() / step).max(1.0));
        self.due += self.wanted * passed;
        let steps = self.due.floor().min(fit.floor()).clamp(0.0, f64::from(MOST));
        self.due = (self.due - steps).min(1.0);
        steps as u32
    }
    /// Steps took so long.
    pub fn stepped(&mut self, steps: u32, took: Duration) {
        if steps > 0 {
            follow(&mut self.step, took.as_secs_f64() / f64::from(steps));
        }
    }
    /// A picture took so long.
    pub fn drawn(&mut self, took: Duration) {
        follow(&mut self.picture, took.as_secs_f64());
    }
}

fn follow(mean: &mut Option<f64>, now: f64) {
    *mean = Some(mean.map_or(now, |mean| mean + FOLLOW * (now - mean)));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cheap_steps_are_made_as_wanted_and_dear_ones_one_by_one() {
        let mut pace = Pace::new(0.01);
        (pace.wanted, pace.step) = (100.0, Some(1e-4));
        let frames: Vec<u32> = (0..60).map(|_| pace.count(1.0 / 60.0)).collect();
        let steps: u32 = frames.iter().sum();
        assert!((99..=100).contains(&steps), "{steps}");
        frames.iter().for_each(|steps| pace.passed(*steps, 1.0 / 60.0));
        assert!((pace.speeds()[1] - 1.0).abs() < 0.3, "{:?}", pace.speeds());
        pace.step = Some(0.1);
        let steps: Vec<u32> = (0..10).map(|_| pace.count(0.1)).collect();
        assert!(steps.iter().all(|steps| *steps == 1), "{steps:?}");
        // A step of half a second is one of two steps per second.
        (0..60).for_each(|_| pace.passed(1, 0.5));
        assert!((pace.rate - 2.0).abs() < 0.01, "{}", pace.rate);
        // What was missed is not made up for.
        pace.step = Some(1e-4);
        assert!(pace.count(0.01) <= 2);
    }
    #[test]
    fn slow_runs_wait_between_steps() {
        let mut pace = Pace::new(0.01);
        (pace.wanted, pace.step) = (10.0, Some(1e-4));
        let steps: Vec<u32> = (0..60).map(|_| pace.count(1.0 / 60.0)).collect();
        assert!((9..=10).contains(&steps.iter().sum::<u32>()), "{steps:?}");
        assert!(steps.iter().all(|steps| *steps <= 1));
    }
}
