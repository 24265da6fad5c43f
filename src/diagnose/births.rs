//! Remarks on emitters.

use super::Remark;
use crate::life::schedule;
use crate::simulation::Setup;

/// Rows of an emitter that are cut off by rounding do not count as an early end.
const ROUNDING: f64 = 1e-6;

/// A line for each emitter: how many it has, and when they leave.
#[must_use]
pub fn forecast(setup: &Setup, end: f64) -> Vec<String> {
    let births = &setup.state.births;
    let line = |(number, (count, first, last)): (usize, &(u64, f64, f64))| {
        let due = births.iter().filter(|birth| birth.emitter as usize == number && birth.time <= end).count();
        let rest = if due as u64 == *count {
            format!("it is empty at {last:.6}")
        } else {
            format!("{} of them are pending when the run ends", count - due as u64)
        };
        format!("emitter {}: {count} particles, spawned from {first:.6} to {last:.6}; {rest}", number + 1)
    };
    schedule(births).iter().enumerate().map(line).collect()
}

/// Emitters that are empty before the run is over.
pub fn early(setup: &Setup, end: f64) -> Vec<Remark> {
    let births = &setup.state.births;
    let line = |(number, (count, first, last)): (usize, &(u64, f64, f64))| {
        let mut times: Vec<f64> = births.iter().filter(|b| b.emitter as usize == number).map(|b| b.time).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        // Rows follow each other evenly.
        let interval = (last - first) / (times.len().max(2) - 1) as f64;
        (last + interval < end - ROUNDING * interval && *count > 0).then(|| {
            let text = format!(
                "emitter {} has {count} particles, and is empty at {last:.4}, before the run ends at {end:.4}",
                number + 1
            );
            Remark::note("empty-emitter", text)
                .with("emitter", (number + 1) as f64)
                .with("particles", *count as f64)
                .with("time", *last)
                .advice("give it a larger `count`, or a later `stop`")
        })
    };
    schedule(births).iter().enumerate().filter_map(line).collect()
}
