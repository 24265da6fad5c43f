//! Measurements of a run that is watched: seldom enough not to slow it down.

use web_time::{Duration, Instant};

/// The least time between two, and the least part of all time that passes without one.
const APART: Duration = Duration::from_millis(200);
const REST: u32 = 20;

/// The times of measurements.
#[derive(Default)]
pub struct Seldom {
    begun: Option<Instant>,
    last: Option<(Instant, Duration)>,
}

impl Seldom {
    /// Whether it is time for the next one, which begins now. Reading a state of many particles takes long, and is done seldom.
    pub fn is_due(&mut self) -> bool {
        let due = self.last.is_none_or(|(at, took)| at.elapsed() > APART.max(took * REST));
        if due {
            self.begun = Some(Instant::now());
        }
        due
    }
    /// It was done.
    pub fn done(&mut self) {
        let took = self.begun.take().map_or(Duration::ZERO, |begun| begun.elapsed());
        self.last = Some((Instant::now(), took));
    }
}
