//! The forces of Helbing, Farkas & Vicsek (2000) on a pedestrian, by another one or by a wall.

use glam::DVec3;

use crate::settings::{Key, Kind, Settings, Value};

/// The amplitude A.
pub(crate) const REPULSION: Key = Key::new(
    "repulsion",
    Kind::NotNegative,
    Value::Number(2000.0),
    "A, the repulsion where discs touch without pressing [mass length / time²]",
);
/// The length B.
pub(crate) const DECAY: Key = Key::new(
    "decay",
    Kind::Positive,
    Value::Number(0.08),
    "B, the distance over which the repulsion falls by e [length]",
);
/// The coefficient k.
pub(crate) const STIFFNESS: Key =
    Key::new("stiffness", Kind::NotNegative, Value::Number(1.2e5), "k, the body force per overlap [mass / time²]");
/// The coefficient κ.
pub(crate) const FRICTION: Key = Key::new(
    "friction",
    Kind::NotNegative,
    Value::Number(2.4e5),
    "κ, the sliding friction per overlap and sliding velocity [mass / (length time)]",
);

/// How many times B a radius may be: the largest overlap is two of them, and exp(80) A is within single precision.
pub const STEEPEST: f64 = 40.0;

/// The coefficients of repulsion and touch.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Press {
    /// A \[mass length / time²\].
    pub repulsion: f64,
    /// B \[length\].
    pub decay: f64,
    /// k \[mass / time²\].
    pub stiffness: f64,
    /// κ \[mass / (length time)\].
    pub friction: f64,
}

impl Press {
    pub(crate) fn of(settings: &Settings) -> Self {
        let number = |name| settings.number(name);
        Self {
            repulsion: number("repulsion"),
            decay: number("decay"),
            stiffness: number("stiffness"),
            friction: number("friction"),
        }
    }
    /// The force on a pedestrian that overlaps something by o, with n from it to the pedestrian, a unit vector, and `between` its velocity
    /// relative to the pedestrian: (w A exp(o / B) + k g) n + κ g u, with g = max(o, 0) and u what of that velocity is across n.
    #[must_use]
    pub fn force(&self, overlap: f64, n: DVec3, between: DVec3, weight: f64) -> DVec3 {
        let touch = overlap.max(0.0);
        let push = weight * self.repulsion * (overlap / self.decay).exp() + self.stiffness * touch;
        push * n + self.friction * touch * (between - between.dot(n) * n)
    }
}
