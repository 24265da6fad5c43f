//! Forces (a stand-in until the real register lands).

use crate::settings::{Key, Kind, Settings, Value};
use glam::DVec3;
use std::borrow::Cow;

/// A force.
pub trait Force {
    /// Its name.
    fn name(&self) -> &str;
}

/// A force of the register.
pub struct Entry {
    /// The scene's word for it.
    pub name: &'static str,
    /// One line.
    pub about: &'static str,
    /// What it may be told.
    pub keys: &'static [Key],
    /// Makes it.
    pub build: fn(&Settings) -> Box<dyn Force>,
}

/// Who meets whom.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Over {
    /// Each alone.
    Each,
    /// All pairs.
    Pairs,
}

/// A user's own law.
#[derive(Debug, Clone, PartialEq)]
pub struct Custom {
    /// Its name.
    pub name: String,
    /// Who meets whom.
    pub over: Over,
    /// The text.
    pub wgsl: String,
    /// The file, for messages.
    pub file: String,
    /// Its parameters.
    pub params: Vec<(String, Value)>,
}

impl Force for Custom {
    fn name(&self) -> &str {
        &self.name
    }
}

struct Stub(&'static str);
impl Force for Stub {
    fn name(&self) -> &str {
        self.0
    }
}

const fn word(w: &'static str) -> Value {
    Value::Text(Cow::Borrowed(w))
}

/// All forces.
pub const FORCES: &[Entry] = &[
    Entry {
        name: "gravity",
        about: "Newton's law",
        keys: &[
            Key::new("g", Kind::Number, Value::Number(1.0), "the constant"),
            Key::new("softening", Kind::NotNegative, Value::Number(0.0), "length"),
            Key::new("kernel", Kind::Choice(&["plummer", "spline"]), word("plummer"), "how"),
            Key::new("over", Kind::Choice(&["pairs"]), word("pairs"), "who meets whom"),
        ],
        build: |_| Box::new(Stub("gravity")),
    },
    Entry {
        name: "uniform",
        about: "constant acceleration",
        keys: &[Key::required("acceleration", Kind::Vector, "acceleration")],
        build: |_| Box::new(Stub("uniform")),
    },
    Entry {
        name: "drag",
        about: "drag",
        keys: &[
            Key::new("linear", Kind::NotNegative, Value::Number(0.0), "1/time"),
            Key::new("quadratic", Kind::NotNegative, Value::Number(0.0), "1/length"),
            Key::new("wind", Kind::Vector, Value::Vector(DVec3::ZERO), "velocity of the air"),
        ],
        build: |_| Box::new(Stub("drag")),
    },
];
