//! Numbers as sums of two of single precision: a high word, which is the number rounded, and a low word, which is the rest.

use glam::{DVec4, Vec4};

use super::{Array, Field, POSITION, Source, VELOCITY};

/// The precision in which positions and velocities are kept.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Precision {
    /// One number of 24 bits.
    #[default]
    Single,
    /// Two numbers, 48 bits: sums are compensated, and forces are those of the high words.
    Compensated,
    /// The same, and forces are those of both words: the difference of two positions is formed from all four before it is rounded.
    DoubleSingle,
}

impl Precision {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Single, Self::Compensated, Self::DoubleSingle];
    /// Their names in scenes.
    pub const NAMES: [&str; 3] = ["single", "compensated", "double_single"];

    /// Its name in scenes.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Single => "single",
            Self::Compensated => "compensated",
            Self::DoubleSingle => "double_single",
        }
    }
    /// The precision of a name in scenes.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|precision| precision.name() == name)
    }
    /// The file with the particle of a law of pairs or links, and the difference of two positions.
    pub(crate) fn particle(self) -> Source {
        match self {
            Self::Single | Self::Compensated => crate::shader!("particle.wgsl"),
            Self::DoubleSingle => crate::shader!("particle_two_words.wgsl"),
        }
    }
    /// Whether positions and velocities have low words.
    #[must_use]
    pub fn is_double(self) -> bool {
        self != Self::Single
    }
}

/// The low words of positions: `xyz` \[length\]. The field exists where the precision has them.
pub const POSITION_LOW: Field<Vec4> = Field::new("position_low");
/// The low words of velocities: `xyz` \[length / time\].
pub const VELOCITY_LOW: Field<Vec4> = Field::new("velocity_low");
/// The fields that may have low words, each with these.
pub const LOW_WORDS: [(Field<Vec4>, Field<Vec4>); 2] = [(POSITION, POSITION_LOW), (VELOCITY, VELOCITY_LOW)];

/// The field of the low words of another.
#[must_use]
pub fn low_words(field: &str) -> Option<&'static str> {
    LOW_WORDS.iter().find(|(high, _)| high.name == field).map(|(_, low)| low.name)
}

/// The corner of a box that changes, which has a low word in any precision.
const CORNER: (&str, &str) = ("box_corner", "box_corner_low");

/// The field of which another holds the low words.
#[must_use]
pub fn high_words(field: &str) -> Option<&'static str> {
    let of_particles = LOW_WORDS.iter().map(|(high, low)| (high.name, low.name));
    of_particles.chain([CORNER]).find(|(_, low)| *low == field).map(|(high, _)| high)
}

/// The low words of some numbers: what rounding to single precision takes from them. The fourth components have none.
#[must_use]
pub fn remainders(numbers: &Array) -> Array {
    let rest = |x: &DVec4| (*x - x.as_vec4().as_dvec4()).with_w(0.0);
    match numbers {
        Array::Vec4(all) => Array::Vec4(all.iter().map(rest).collect()),
        other => other.zeros(other.len()),
    }
}

/// Numbers with their low words added.
#[must_use]
pub fn joined(high: Array, low: &Array) -> Array {
    match (high, low) {
        (Array::Vec4(high), Array::Vec4(low)) => Array::Vec4(high.iter().zip(low).map(|(a, b)| *a + *b).collect()),
        (high, _) => high,
    }
}
