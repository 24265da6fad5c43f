//! Requests to end a run before its last step.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use web_time::{Duration, Instant};

/// A request to end a run early: the run finishes its batch of steps, writes a checkpoint and its last state, and can continue later.
/// Clones share the request, so that a signal handler or another thread can make it.
#[derive(Debug, Clone)]
pub struct Stop {
    asked: Arc<AtomicBool>,
    since: Instant,
    longest: Option<Duration>,
}

impl Default for Stop {
    fn default() -> Self {
        Self { asked: Arc::default(), since: Instant::now(), longest: None }
    }
}

impl Stop {
    /// A request that also ends a run after the duration `longest` from now.
    #[must_use]
    pub fn after(longest: Duration) -> Self {
        Self { longest: Some(longest), ..Self::default() }
    }
    /// Requests the end of the run.
    pub fn ask(&self) {
        self.asked.store(true, Ordering::Relaxed);
    }
    /// Whether the end was requested.
    #[must_use]
    pub fn is_asked(&self) -> bool {
        self.asked.load(Ordering::Relaxed)
    }
    /// Whether the run must end now, where writing its end takes this long.
    #[must_use]
    pub fn asked(&self, end: Duration) -> bool {
        self.is_asked() || self.longest.is_some_and(|longest| self.since.elapsed() + end >= longest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_request_and_a_limit_of_time_end_a_run() {
        let stop = Stop::default();
        assert!(!stop.asked(Duration::from_hours(1)));
        stop.clone().ask();
        assert!(stop.asked(Duration::ZERO) && stop.is_asked());
        let stop = Stop::after(Duration::from_hours(1));
        assert!(!stop.asked(Duration::from_mins(50)) && stop.asked(Duration::from_hours(1)) && !stop.is_asked());
    }
}
