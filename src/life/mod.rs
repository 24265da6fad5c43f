//! Life of particles: births by a schedule, and drains. How many particles there are is fixed for a run, and so are their ids: a particle that is
//! to be spawned is pending among them from the start, and a removed one stays among them, so that no id is ever used twice.

mod check;
mod population;

use glam::DVec3;

#[doc(hidden)]
pub use check::check;
#[doc(hidden)]
pub use population::{Population, schedule};

use crate::solids::Solid;

/// The life of a particle. One that is not active is in no cell list, has no acceleration, no mass and no velocity, and is not drawn.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Life {
    /// To be spawned, at this position.
    Pending,
    /// In the simulation.
    #[default]
    Active,
    /// Removed, at the position where that happened.
    Removed,
}

impl Life {
    /// The word that shaders and files know it by: 0, 1 or 2.
    #[must_use]
    pub fn word(self) -> u32 {
        self as u32
    }
    /// What a word stands for, if for anything.
    #[must_use]
    pub fn of(word: u32) -> Option<Self> {
        [Self::Pending, Self::Active, Self::Removed].into_iter().find(|life| life.word() == word)
    }
}

/// When and how a pending particle is spawned. At the end of the first step that reaches its time it is placed where it would be
/// if it had left its initial position at that time, at this velocity. Only pending particles are spawned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Birth {
    /// Its id.
    pub id: u32,
    /// The time \[time\].
    pub time: f64,
    /// How it moves \[length / time\].
    pub velocity: DVec3,
    /// Mass \[mass\].
    pub mass: f64,
    /// How long it moves at constant velocity without forces, so that the jet ahead of it has pressure behind it \[time\].
    pub guided: f64,
    /// The emitter that it is of, as a number that messages know it by.
    pub emitter: u32,
}

/// A drain: a region in which particles are removed at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drain {
    /// Its shape. A plane is the half space that its normal points away from.
    pub solid: Solid,
    /// Its centre; of a plane a point on it \[length\].
    pub position: DVec3,
    /// Whether particles are removed outside of the shape instead of inside.
    pub outside: bool,
    /// The species that it removes; all, but fixed particles, where none is named.
    pub species: Option<u32>,
}

/// Words of a birth in the table that `shaders/life/spawn.wgsl` reads.
const WORDS: usize = 8;

/// That table, one `Birth` of the shader behind another.
#[doc(hidden)]
#[must_use]
pub fn table(births: &[Birth]) -> Vec<u32> {
    #[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is what the device does")]
    let bits = |x: f64| (x as f32).to_bits();
    let row = |birth: &Birth| -> [u32; WORDS] {
        let [x, y, z] = birth.velocity.to_array().map(bits);
        [x, y, z, bits(birth.time), birth.id, bits(birth.mass), bits(birth.time + birth.guided), 0]
    };
    births.iter().flat_map(row).collect()
}
