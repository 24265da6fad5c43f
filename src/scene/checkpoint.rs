//! `[checkpoint]`: intervals of checkpoints.

use crate::settings::{Key, Kind, Settings, Value};

use super::report::{Fault, Report};
use super::resolved::Writer;
use super::tree::Data;
use super::walk::Table;

/// The keys of the section, beside `every`.
pub(super) const KEYS: &[Key] =
    &[Key::new("keep", Kind::Count, Value::Number(2.0), "how many checkpoints are kept, the newest ones")];
pub(super) const OWN: &[&str] = &["every"];

/// The times of checkpoints, in addition to that of a run that is stopped.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Every {
    /// Each time that this many seconds have passed; positive.
    Wall(f64),
    /// Each time that this many steps are done; at least one.
    Steps(u64),
    /// Each time that this much simulated time has passed; positive.
    Time(f64),
    /// Only when a run is stopped.
    Never,
}

/// Checkpoints of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Checkpoints {
    /// The times.
    pub every: Every,
    /// The number that is kept; at least one.
    pub keep: usize,
}

const UNITS: [(&str, f64); 3] = [("s", 1.0), ("min", 60.0), ("h", 3600.0)];
const FORMS: &str = "a number and a unit: \"10 min\" (s, min or h) of wall-clock time, \"5000 steps\", \"0.5 time\" of the scene, or \"never\"";
/// Ten minutes.
const DEFAULT: Every = Every::Wall(600.0);

impl Every {
    pub(super) fn parse(text: &str) -> Option<Self> {
        if text.trim() == "never" {
            return Some(Self::Never);
        }
        let (number, unit) = text.trim().split_once(' ')?;
        if unit.trim() == "steps" {
            return number.parse().ok().filter(|steps| *steps > 0).map(Self::Steps);
        }
        let number = number.parse().ok().filter(|number: &f64| number.is_finite() && *number > 0.0)?;
        let seconds = UNITS.iter().find(|(name, _)| *name == unit.trim()).map(|(_, seconds)| number * seconds);
        let time = (unit.trim() == "time").then_some(Self::Time(number));
        seconds.filter(|seconds| seconds.is_finite()).map(Self::Wall).or(time)
    }
    fn text(self) -> String {
        match self {
            Self::Wall(seconds) => format!("{seconds:?} s"),
            Self::Steps(steps) => format!("{steps} steps"),
            Self::Time(time) => format!("{time:?} time"),
            Self::Never => "never".to_owned(),
        }
    }
}

/// The smallest interval of time, as a part of dt; a smaller one is a mistake. From here on whole intervals are counted exactly: 2³² steps
/// have fewer than 2⁵³.
const LEAST: f64 = 1e-6;

/// Reads the section of a scene with steps of `dt`.
pub(super) fn read(table: Option<&Table<'_>>, dt: f64, report: &mut Report) -> Checkpoints {
    let settings = table.map_or_else(|| Settings::defaults(KEYS), |table| table.settings(KEYS, OWN, report));
    let mut every = DEFAULT;
    if let Some(entry) = table.and_then(|table| table.get("every")) {
        let text = if let Data::Text(text) = &entry.node.data { Every::parse(text) } else { None };
        match text {
            Some(Every::Time(time)) if time < LEAST * dt => {
                let label = format!(
                    "{time:?} is less than a millionth of dt = {dt:?}: a checkpoint after every step is \"1 steps\""
                );
                report.push(Fault::at(&entry.node.place, "`every` is far below a step").label(label));
            }
            Some(given) => every = given,
            None => {
                report.push(
                    Fault::at(&entry.node.place, "`every` is not a valid interval")
                        .label(format!("it must be {FORMS}")),
                );
            }
        }
    }
    Checkpoints { every, keep: usize::try_from(settings.whole("keep")).unwrap_or(1).max(1) }
}

impl Checkpoints {
    pub(super) fn write(&self, out: &mut Writer) {
        out.header("[checkpoint]");
        out.text("every", &self.every.text());
        out.line("keep", &self.keep.to_string());
    }
}

#[cfg(test)]
mod tests {
    use super::Every;

    #[test]
    fn intervals_are_read_and_written() {
        let cases = [
            ("10 min", Some(Every::Wall(600.0))),
            ("0.5 h", Some(Every::Wall(1800.0))),
            ("90 s", Some(Every::Wall(90.0))),
            ("500 steps", Some(Every::Steps(500))),
            ("0.25 time", Some(Every::Time(0.25))),
            ("never", Some(Every::Never)),
        ];
        for (text, every) in cases {
            assert_eq!(Every::parse(text), every, "{text}");
            assert_eq!(every.and_then(|every| Every::parse(&every.text())), every, "{text}");
        }
        for text in [
            "",
            "10",
            "min",
            "0 s",
            "-1 h",
            "NaN s",
            "inf min",
            "1e308 h",
            "0 steps",
            "1.5 steps",
            "10 days",
            "10 min x",
        ] {
            assert_eq!(Every::parse(text), None, "{text}");
        }
    }
}
