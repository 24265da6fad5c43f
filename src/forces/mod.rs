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

const EACH: Key = Key::new("over", Kind::Choice(&["each"]), word("each"), "who meets whom: each particle alone");
const ZERO: Value = Value::Vector(DVec3::ZERO);
const fn num(x: f64) -> Value {
    Value::Number(x)
}
macro_rules! stubs {
    ($($name:literal: $keys:expr;)*) => {
        /// All forces.
        pub const FORCES: &[Entry] =
            &[$(Entry { name: $name, about: "", keys: $keys, build: |_| Box::new(Stub($name)) }),*];
    };
}

stubs! {
    "gravity": &[
        Key::new("g", Kind::Number, num(1.0), "the gravitational constant [length³ / mass / time²]"),
        Key::new("softening", Kind::NotNegative, num(0.0), "the Plummer softening length"),
        Key::new("kernel", Kind::Choice(&["plummer", "spline"]), word("plummer"), "how close encounters are softened"),
        Key::new("over", Kind::Choice(&["pairs"]), word("pairs"), "who meets whom: everybody"),
    ];
    "uniform": &[Key::new("acceleration", Kind::Vector, Value::Vector(DVec3::new(0.0, 0.0, -9.81)), "the acceleration"), EACH];
    "drag": &[
        Key::new("linear", Kind::NotNegative, num(0.0), "linear"),
        Key::new("quadratic", Kind::NotNegative, num(0.0), "quadratic"),
        Key::new("wind", Kind::Vector, ZERO, "wind"),
        EACH,
    ];
    "wind": &[
        Key::new("velocity", Kind::Vector, Value::Vector(DVec3::X), "velocity"),
        Key::new("rate", Kind::NotNegative, num(1.0), "rate"),
        Key::new("gust", Kind::NotNegative, num(0.0), "gust"),
        Key::new("period", Kind::Positive, num(1.0), "period"),
        Key::new("wavelength", Kind::Positive, num(1.0), "wavelength"),
        EACH,
    ];
    "vortex": &[
        Key::new("center", Kind::Vector, ZERO, "center"),
        Key::new("axis", Kind::Direction, Value::Vector(DVec3::Z), "axis"),
        Key::new("circulation", Kind::Number, num(1.0), "circulation"),
        Key::new("core", Kind::Positive, num(0.1), "core"),
        Key::new("rate", Kind::NotNegative, num(1.0), "rate"),
        EACH,
    ];
    "attractor": &[
        Key::new("position", Kind::Vector, ZERO, "position"),
        Key::new("velocity", Kind::Vector, ZERO, "velocity"),
        Key::new("profile", Kind::Choice(&["point", "harmonic", "logarithmic"]), word("point"), "profile"),
        Key::new("strength", Kind::Number, num(1.0), "strength"),
        Key::new("softening", Kind::NotNegative, num(0.0), "softening"),
        EACH,
    ];
}
