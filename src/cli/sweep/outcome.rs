//! The outcome of a run, and the difference of its final state from that of another.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use motes::run::{End, Run};
use motes::{Bounds, Energy, State};
use serde_json::{Value, json};

use super::vary::Varied;
use crate::cli::failure::Failure;

/// The results of a run.
pub struct Outcome {
    /// Its measurements and its final state, or its failure.
    result: Result<Left, Failure>,
    steps: u64,
    /// The duration of its steps.
    took: Duration,
}

/// The results of a run that finished: its first and its last measurement, the largest change of the energy, and its final state.
struct Left {
    ends: [Energy; 2],
    change: f64,
    state: State,
    bounds: Bounds,
}

/// A row of the table: a run compared with the others.
pub struct Ended<'a> {
    /// Its overrides.
    pub case: &'a [String],
    pub steps: u64,
    pub seconds: f64,
    /// The mean length of its steps \[time\].
    pub dt: f64,
    /// The change of the total energy from the first measurement to the last, relative to the first; and the largest change.
    pub energy: f64,
    pub worst_energy: f64,
    /// The change of the momentum \[mass length / time\].
    pub momentum: f64,
    /// The differences of final positions from those of the last run: root mean square, and maximum \[length\]. `None` for the last
    /// run, and if the particles differ.
    pub difference: Option<[f64; 2]>,
    /// Its failure, if it did not finish.
    pub error: Option<String>,
}

impl Outcome {
    /// The row of a run.
    pub fn of(made: Result<(Run, End), Failure>) -> Self {
        let (steps, took) = made.as_ref().map_or((0, Duration::ZERO), |(_, end)| (end.steps, end.stepping));
        let result = made.and_then(|(run, end)| {
            let ends = [run.energies().first(), run.energies().last()].map(|row| row.copied().unwrap_or_default());
            let (given, change) = (run.scene().bounds, run.looks.change);
            let state = Arc::unwrap_or_clone(run.last.filter(|_| !end.stopped).ok_or(Failure::Stopped)?);
            let bounds = state.boxed(&given);
            Ok(Left { ends, change, state, bounds })
        });
        Self { result, steps, took }
    }
    /// A short description.
    pub fn words(&self, folder: &Path) -> String {
        match &self.result {
            Err(Failure::Stopped) => format!("stopped; motes resume {} continues it", folder.display()),
            Err(failure) => format!("failed: {}", failure.words().lines().next().unwrap_or_default()),
            Ok(_) => format!("{} steps in {:.2} s", self.steps, self.took.as_secs_f64()),
        }
    }
    /// Whether it failed; a stopped run has not failed.
    pub fn has_failed(&self) -> bool {
        matches!(&self.result, Err(failure) if !matches!(failure, Failure::Stopped))
    }
    /// The reason.
    pub fn failure(self) -> Option<Failure> {
        self.result.err()
    }
}

/// The rows of all runs; the last one that finished is the reference of final states.
pub fn compared<'a>(cases: &'a [Vec<String>], found: &'a [Option<Outcome>]) -> Vec<Ended<'a>> {
    let ran: Vec<_> = cases.iter().zip(found).filter_map(|(case, one)| Some((case, one.as_ref()?))).collect();
    let last = ran.iter().rposition(|(_, one)| one.result.is_ok());
    let reference = last.and_then(|place| ran[place].1.result.as_ref().ok());
    let one = |(place, (case, one)): (usize, &(&'a Vec<String>, &'a Outcome))| {
        let mut ended = Ended {
            case,
            steps: one.steps,
            seconds: one.took.as_secs_f64(),
            energy: f64::NAN,
            worst_energy: f64::NAN,
            momentum: f64::NAN,
            difference: None,
            dt: f64::NAN,
            error: one.result.as_ref().err().map(Failure::words),
        };
        if let Ok(Left { ends: [first, end], change, state, bounds }) = &one.result {
            ended.dt = state.time / state.step as f64;
            ended.energy = end.drift_from(first);
            ended.worst_energy = if first.total() == 0.0 { *change } else { change / first.total().abs() };
            ended.momentum = (end.momentum - first.momentum).length();
            ended.difference =
                reference.filter(|_| Some(place) != last).and_then(|other| apart(bounds, [state, &other.state]));
        }
        ended
    };
    ran.iter().enumerate().map(one).collect()
}

/// Whether two states have the same time up to rounding.
fn simultaneous(a: &State, b: &State) -> bool {
    (a.time - b.time).abs() <= 1e-9 * a.time.abs().max(b.time.abs())
}

/// Whether all runs that finished ended at the same time.
pub fn end_together(found: &[Option<Outcome>]) -> bool {
    let mut states = found.iter().flatten().filter_map(|one| one.result.as_ref().ok()).map(|left| &left.state);
    states.next().is_none_or(|first| states.all(|other| simultaneous(first, other)))
}

/// The distances between the particles of two states, by their ids and to the nearest images.
fn apart(bounds: &Bounds, [a, b]: [&State; 2]) -> Option<[f64; 2]> {
    if !simultaneous(a, b) || a.len() != b.len() || a.ids() != b.ids() || a.is_empty() {
        return None;
    }
    let squares = || a.position().iter().zip(b.position()).map(|(x, y)| bounds.shortest(*x - *y).length_squared());
    Some([(squares().sum::<f64>() / a.len() as f64).sqrt(), squares().fold(0.0, f64::max).sqrt()])
}

/// The order of convergence, if dt alone is varied and decreases from run to run: by least squares of the logarithms of differences
/// from the last run, which counts as exact, over those of dt; `None` if fewer than three runs differ from it.
pub fn order(varied: &[Varied], ended: &[Ended<'_>]) -> Option<f64> {
    let falls = ended.windows(2).all(|two| two[1].dt < two[0].dt);
    if varied.len() != 1 || varied[0].key != "simulation.dt" || !falls {
        return None;
    }
    let points: Vec<[f64; 2]> =
        ended.iter().filter_map(|one| Some([one.dt.ln(), one.difference.filter(|d| d[0] > 0.0)?[0].ln()])).collect();
    if points.len() < 3 {
        return None;
    }
    let mean = |k: usize| points.iter().map(|point| point[k]).sum::<f64>() / points.len() as f64;
    let [mx, my] = [mean(0), mean(1)];
    let sum = |f: &dyn Fn(&[f64; 2]) -> f64| points.iter().map(f).sum::<f64>();
    let slope = sum(&|p| (p[0] - mx) * (p[1] - my)) / sum(&|p| (p[0] - mx) * (p[0] - mx));
    slope.is_finite().then_some(slope)
}

impl Ended<'_> {
    /// The values of its overrides, without their keys.
    pub fn values(&self) -> Vec<&str> {
        self.case.iter().map(|set| set.split_once('=').map_or("", |(_, value)| value)).collect()
    }
    /// As JSON.
    pub fn json(&self, varied: &[Varied]) -> Value {
        let set: serde_json::Map<String, Value> =
            varied.iter().zip(self.values()).map(|(one, value)| (one.key.clone(), json!(value))).collect();
        json!({ "set": set, "steps": self.steps, "dt": self.dt, "seconds": self.seconds, "energy_error": self.energy,
            "worst_energy_error": self.worst_energy, "momentum_change": self.momentum,
            "difference_rms": self.difference.map(|d| d[0]), "difference_max": self.difference.map(|d| d[1]), "error": self.error })
    }
}
