//! The progress of a run: a bar on a terminal, lines in a log, JSON for programs, or nothing.

use std::io::IsTerminal;
use std::path::Path;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use motes::{Energy, run};
use serde_json::{Value, json};

use super::args::ShowArgs;
use super::words::duration;

/// The version of the JSON events.
pub const SCHEMA: u32 = 1;
/// The minimum time between two lines of a log.
const PAUSE: Duration = Duration::from_secs(2);

/// The form in which progress is reported.
pub struct Progress {
    kind: Kind,
    start: Instant,
    last: Option<Instant>,
    /// The first and the last step of the run.
    begun: u64,
    steps: u64,
}

enum Kind {
    Bar(ProgressBar),
    Lines,
    Json,
    Quiet,
}

impl Progress {
    /// Chosen by the arguments, and by whether standard error is a terminal.
    pub fn new(args: &ShowArgs, begun: u64, steps: u64) -> Self {
        let kind = match (args.json, args.quiet, std::io::stderr().is_terminal()) {
            (true, ..) => Kind::Json,
            (_, true, _) => Kind::Quiet,
            (.., true) => {
                let bar = ProgressBar::new(steps);
                let template = "{bar:30} {human_pos}/{human_len} steps  {per_sec}  {eta} left  {msg}";
                if let Ok(style) = ProgressStyle::with_template(template) {
                    bar.set_style(style);
                }
                Kind::Bar(bar)
            }
            _ => Kind::Lines,
        };
        Self { kind, start: Instant::now(), last: None, begun, steps }
    }
    /// Prints an event as JSON, if requested.
    pub fn event(&self, name: &str, mut fields: Value) {
        if let (Kind::Json, Some(map)) = (&self.kind, fields.as_object_mut()) {
            map.insert("event".to_owned(), json!(name));
            map.insert("schema".to_owned(), json!(SCHEMA));
            out!("{fields}");
        }
    }
    /// Prints a line, unless JSON was requested or the run is quiet.
    pub fn say(&self, text: &str) {
        match &self.kind {
            Kind::Bar(bar) => bar.suspend(|| note!("{text}")),
            Kind::Lines => note!("{text}"),
            Kind::Json | Kind::Quiet => {}
        }
    }
    /// Prints a line of the result.
    pub fn conclude(&self, text: &str) {
        match &self.kind {
            Kind::Bar(_) | Kind::Lines => out!("{text}"),
            Kind::Json | Kind::Quiet => {}
        }
    }
    /// Ends the report. Returns the duration of the run.
    pub fn finish(&self) -> Duration {
        if let Kind::Bar(bar) = &self.kind {
            bar.finish_and_clear();
        }
        self.start.elapsed()
    }
}

impl run::Progress for Progress {
    fn remark(&mut self, text: &str) {
        self.say(&format!("note: {text}"));
        self.event("remark", json!({ "text": text }));
    }
    fn warning(&mut self, text: &str) {
        self.say(&format!("warning: {text}"));
        self.event("remark", json!({ "text": text }));
    }
    fn at(&mut self, step: u64) {
        match &self.kind {
            Kind::Bar(bar) => bar.set_position(step),
            Kind::Lines if self.last.is_none_or(|last| last.elapsed() > PAUSE) => {
                if self.last.is_some() && step < self.steps {
                    let left = self
                        .start
                        .elapsed()
                        .mul_f64((self.steps - step) as f64 / step.saturating_sub(self.begun).max(1) as f64);
                    note!("step {step} of {}, about {} left", self.steps, duration(left));
                }
                self.last = Some(Instant::now());
            }
            _ => {}
        }
    }
    fn measured(&mut self, row: &Energy, first: &Energy) {
        self.energy(row, first);
        self.event(
            "progress",
            json!({ "step": row.step, "time": row.time, "kinetic": row.kinetic, "potential": row.potential,
                "total": row.total(), "energy_error": row.drift_from(first) }),
        );
    }
    fn watched(&self) -> bool {
        matches!(self.kind, Kind::Bar(_))
    }
    fn energy(&mut self, row: &Energy, first: &Energy) {
        if let Kind::Bar(bar) = &self.kind {
            bar.set_message(format!("energy error {:.1e}", row.drift_from(first)));
        }
    }
    fn frame(&mut self, frame: usize, step: u64, file: &Path) {
        self.event("frame", json!({ "frame": frame, "step": step, "file": file }));
    }
    fn checkpoint(&mut self, step: u64, file: &Path) {
        self.event("checkpoint", json!({ "step": step, "file": file }));
    }
}
