//! What came of a run, and how far its end is from that of another.

use std::time::Duration;

use motes::run::{End, Run};
use motes::{Measure, State};
use serde_json::{Value, json};

use super::vary::Varied;

/// What a run left.
pub struct Outcome {
    /// Its measurements and its last state, or why it did not come to its end.
    result: Result<Left, String>,
    steps: u64,
    /// How long its steps took.
    took: Duration,
}

/// What a run that came to its end left: its first and its last measurement, the largest change of the energy, and its last state.
struct Left {
    ends: [Measure; 2],
    change: f64,
    state: State,
}

/// A run beside the others.
pub struct Ended<'a> {
    /// What was set for it.
    pub case: &'a [String],
    pub steps: u64,
    pub seconds: f64,
    /// The change of the total energy from the first measurement to the last, relative to the first, and the largest on the way.
    pub energy: f64,
    pub worst_energy: f64,
    /// The change of the momentum \[mass length / time\].
    pub momentum: f64,
    /// How far particles end from where those of the last run do: root of the mean square, and at most \[length\]. `None` in the last
    /// run, and where there are others.
    pub difference: Option<[f64; 2]>,
    /// Why it did not come to its end.
    pub error: Option<&'a str>,
}

impl Outcome {
    /// Of a run that was made.
    pub fn of(made: Result<(Run, End), String>) -> Self {
        let (steps, took) = made.as_ref().map_or((0, Duration::ZERO), |(_, end)| (end.steps, end.stepping));
        let result = made.and_then(|(run, end)| {
            let ends = [run.energies.first(), run.energies.rows().last().copied().unwrap_or_default()];
            let state = run.last.ok_or("it left no state")?;
            if end.stopped { Err("stopped".to_owned()) } else { Ok(Left { ends, change: run.looks.change, state }) }
        });
        Self { result, steps, took }
    }
    /// In a few words.
    pub fn words(&self) -> String {
        match &self.result {
            Ok(_) => format!("{} steps in {:.2} s", self.steps, self.took.as_secs_f64()),
            Err(error) => format!("failed: {}", error.lines().next().unwrap_or_default()),
        }
    }
}

/// All that ran, the last that came to its end as what ends are compared with.
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
            error: one.result.as_ref().err().map(String::as_str),
        };
        if let Ok(Left { ends: [first, end], change, state }) = &one.result {
            ended.energy = end.drift_from(first);
            ended.worst_energy = if first.total() == 0.0 { *change } else { change / first.total().abs() };
            ended.momentum = (end.momentum - first.momentum).length();
            ended.difference = reference.filter(|_| Some(place) != last).and_then(|other| apart(state, &other.state));
        }
        ended
    };
    ran.iter().enumerate().map(one).collect()
}

/// Whether two states are of one time, but for rounding.
fn simultaneous(a: &State, b: &State) -> bool {
    (a.time - b.time).abs() <= 1e-9 * a.time.abs().max(b.time.abs())
}

/// Whether all runs that came to their end ended at one time.
pub fn end_together(found: &[Option<Outcome>]) -> bool {
    let mut states = found.iter().flatten().filter_map(|one| one.result.as_ref().ok()).map(|left| &left.state);
    states.next().is_none_or(|first| states.all(|other| simultaneous(first, other)))
}

/// How far the particles of two states of one time are from each other, by their ids.
fn apart(a: &State, b: &State) -> Option<[f64; 2]> {
    if !simultaneous(a, b) || a.len() != b.len() || a.ids() != b.ids() || a.is_empty() {
        return None;
    }
    let squares = || a.position().iter().zip(b.position()).map(|(x, y)| (*x - *y).length_squared());
    Some([(squares().sum::<f64>() / a.len() as f64).sqrt(), squares().fold(0.0, f64::max).sqrt()])
}

/// The power of a varied number with which differences from the last run fall, by least squares of their logarithms; `None` unless
/// one number above 0 is varied and three runs or more differ from the last. The last run is taken for exact.
pub fn order(varied: &[Varied], ended: &[Ended<'_>]) -> Option<f64> {
    let [one] = varied else { return None };
    let numbers = one.numbers()?;
    if numbers.len() != ended.len() {
        return None;
    }
    let points: Vec<[f64; 2]> = numbers
        .iter()
        .zip(ended)
        .filter_map(|(x, one)| Some([*x, one.difference?[0]]))
        .filter(|point| point.iter().all(|x| *x > 0.0))
        .map(|point| point.map(f64::ln))
        .collect();
    if points.len() < 3 {
        return None;
    }
    let count = points.len() as f64;
    let mean = |k: usize| points.iter().map(|point| point[k]).sum::<f64>() / count;
    let [mx, my] = [mean(0), mean(1)];
    let sum = |f: &dyn Fn(&[f64; 2]) -> f64| points.iter().map(f).sum::<f64>();
    let slope = sum(&|p| (p[0] - mx) * (p[1] - my)) / sum(&|p| (p[0] - mx) * (p[0] - mx));
    slope.is_finite().then_some(slope)
}

impl Ended<'_> {
    /// The values that were set, without their keys.
    pub fn values(&self) -> Vec<&str> {
        self.case.iter().map(|set| set.split_once('=').map_or("", |(_, value)| value)).collect()
    }
    /// As JSON.
    pub fn json(&self, varied: &[Varied]) -> Value {
        let set: serde_json::Map<String, Value> =
            varied.iter().zip(self.values()).map(|(one, value)| (one.key.clone(), json!(value))).collect();
        json!({ "set": set, "steps": self.steps, "seconds": self.seconds, "energy_error": self.energy,
            "worst_energy_error": self.worst_energy, "momentum_change": self.momentum,
            "difference_rms": self.difference.map(|d| d[0]), "difference_max": self.difference.map(|d| d[1]), "error": self.error })
    }
}
