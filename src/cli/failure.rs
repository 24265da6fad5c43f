//! Errors as a message on standard error and an exit code.

use std::process::ExitCode;

use std::sync::OnceLock;

use motes::Error;
use motes::scene::{Diagnostic, Diagnostics};
use serde_json::{Value, json};

use super::progress::SCHEMA;

/// Whether failures go to standard output as JSON, too.
pub static JSON: OnceLock<bool> = OnceLock::new();

/// Prints a failure as an event, if JSON was requested.
pub fn event(code: u8, mut fields: Value) {
    if let (Some(true), Some(map)) = (JSON.get(), fields.as_object_mut()) {
        map.extend(
            [("event", json!("error")), ("schema", json!(SCHEMA)), ("code", json!(code))]
                .map(|(key, value)| (key.to_owned(), value)),
        );
        out!("{fields}");
    }
}

fn fault(one: &Diagnostic) -> Value {
    let place = one.excerpt.as_ref().and_then(|excerpt| excerpt.position);
    json!({ "message": one.message, "file": one.file, "line": place.map(|(line, _)| line), "column": place.map(|(_, column)| column),
        "label": one.excerpt.as_ref().map(|excerpt| &excerpt.label), "notes": one.notes })
}

/// The failure of a command.
pub enum Failure {
    /// The scene has faults.
    Scene(Diagnostics),
    /// Any other error.
    Error(Error),
    /// An error of a run, and an explanation.
    Explained(Error, String),
    /// Device and references disagree, a self test failed, or a claim does not hold; the table that says so is printed already.
    Disagreement,
    /// Stopped by a signal; everything up to there is written.
    Stopped,
}

impl Failure {
    /// Its message.
    pub fn words(&self) -> String {
        match self {
            Self::Scene(faults) => faults.to_string(),
            Self::Error(error) => error.to_string(),
            Self::Explained(error, more) => format!("{error}\n{more}"),
            Self::Disagreement => "device and references disagree".to_owned(),
            Self::Stopped => "stopped".to_owned(),
        }
    }
    /// Prints it, and returns the exit code that `motes --help` lists.
    pub fn report(self) -> ExitCode {
        let code = match &self {
            Self::Scene(faults) => faults.exit_code(),
            Self::Error(error) | Self::Explained(error, _) => error.exit_code(),
            Self::Disagreement => 9,
            Self::Stopped => 75,
        };
        match &self {
            Self::Scene(faults) => {
                event(
                    code,
                    json!({ "text": self.words(), "faults": faults.list.iter().map(fault).collect::<Vec<_>>() }),
                );
            }
            Self::Error(error) => event(code, json!({ "text": error.to_string() })),
            Self::Explained(error, more) => event(code, json!({ "text": error.to_string(), "more": more })),
            // The printed document contains it.
            Self::Disagreement | Self::Stopped => {}
        }
        match &self {
            Self::Scene(_) => note!("{}", self.words()),
            Self::Error(_) | Self::Explained(..) => note!("error: {}", self.words()),
            // Printed already.
            Self::Disagreement | Self::Stopped => {}
        }
        ExitCode::from(code)
    }
}

impl From<Diagnostics> for Failure {
    fn from(faults: Diagnostics) -> Self {
        Self::Scene(faults)
    }
}

impl From<Error> for Failure {
    fn from(error: Error) -> Self {
        Self::Error(error)
    }
}
