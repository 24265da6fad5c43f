//! The times at which checkpoints are due.

use web_time::{Duration, Instant};

use crate::scene::Every;

/// The time at which the next checkpoint is due.
#[derive(Debug)]
pub(super) struct Schedule {
    every: Every,
    since: Instant,
    /// The number of whole intervals up to the last one.
    gone: u64,
    /// The time that the last one took to write.
    pub(super) took: Duration,
}

impl Schedule {
    /// For a run that begins after `steps` steps, at this time.
    pub(super) fn new(every: Every, steps: u64, time: f64) -> Self {
        let mut schedule = Self { every, since: Instant::now(), gone: 0, took: Duration::ZERO };
        schedule.gone = schedule.intervals(steps, time);
        schedule
    }
    /// The number of whole intervals from the start of the run, for intervals of steps or time.
    fn intervals(&self, steps: u64, time: f64) -> u64 {
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "above 0, or saturated")]
        match self.every {
            Every::Steps(some) => steps / some.max(1),
            Every::Time(some) => (time / some) as u64,
            Every::Wall(_) | Every::Never => 0,
        }
    }
    /// The number of steps of at most `dt` before one may be due; at least one.
    pub(super) fn most(&self, steps: u64, time: f64, dt: f64) -> u64 {
        match self.every {
            Every::Steps(some) => some.max(1) - steps % some.max(1),
            Every::Time(some) => {
                let left = self.intervals(steps, time).saturating_add(1) as f64 * some - time;
                #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "above 0, or saturated")]
                let most = (left / dt).ceil() as u64;
                most.max(1)
            }
            Every::Wall(_) | Every::Never => u64::MAX,
        }
    }
    /// Whether one is due.
    pub(super) fn is_due(&self, steps: u64, time: f64) -> bool {
        match self.every {
            Every::Wall(seconds) => self.since.elapsed().as_secs_f64() >= seconds,
            _ => self.intervals(steps, time) > self.gone,
        }
    }
    /// Records a checkpoint whose writing began at this instant.
    pub(super) fn written(&mut self, steps: u64, time: f64, begun: Instant) {
        (self.gone, self.since, self.took) = (self.intervals(steps, time), Instant::now(), begun.elapsed());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_and_time_are_counted_from_the_start_of_the_run() {
        let now = Instant::now();
        let mut steps = Schedule::new(Every::Steps(10), 23, 2.3);
        assert_eq!([steps.most(23, 2.3, 0.1), steps.most(30, 3.0, 0.1)], [7, 10]);
        assert!(!steps.is_due(29, 2.9) && steps.is_due(30, 3.0) && steps.is_due(31, 3.1));
        steps.written(31, 3.1, now);
        assert!(!steps.is_due(39, 3.9) && steps.is_due(40, 4.0));
        let time = Schedule::new(Every::Time(0.5), 23, 2.3);
        assert_eq!(time.most(23, 2.3, 0.1), 3); // 0.2 / 0.1 rounds up: 2.0000000000000018
        assert!(!time.is_due(24, 2.4) && time.is_due(26, 2.6));
        assert_eq!(Schedule::new(Every::Time(1e-300), 1, 1.0).most(1, 1.0, 0.1), 1);
        let wall = Schedule::new(Every::Wall(3600.0), 0, 0.0);
        assert!(!wall.is_due(1 << 40, 1e9) && Schedule::new(Every::Wall(0.0), 0, 0.0).is_due(0, 0.0));
        assert!(!Schedule::new(Every::Never, 0, 0.0).is_due(1 << 40, 1e9));
    }
}
