//! Life of particles: scheduled births, and drains. The number of particles and their ids are constant during a run: a particle to be
//! spawned is included as pending from the start, and a removed one stays included, so that no id is ever reused.

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
    /// Its value in shaders and files: 0, 1 or 2.
    #[must_use]
    pub fn word(self) -> u32 {
        self as u32
    }
    /// The life with this value, if there is one.
    #[must_use]
    pub fn of(word: u32) -> Option<Self> {
        [Self::Pending, Self::Active, Self::Removed].into_iter().find(|life| life.word() == word)
    }
}

/// The time and the velocity at which a pending particle is spawned. At the end of the first step that reaches this time it is placed where
/// it would be if it had left its initial position at that time with this velocity. Only pending particles are spawned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Birth {
    /// Its id.
    pub id: u32,
    /// The time \[time\].
    pub time: f64,
    /// The velocity \[length / time\].
    pub velocity: DVec3,
    /// Mass \[mass\].
    pub mass: f64,
    /// The duration of its motion at constant velocity without forces, so that the jet ahead of it is under pressure \[time\].
    pub guided: f64,
    /// The number of its emitter, for messages.
    pub emitter: u32,
}

/// A drain: a region in which particles are removed at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Drain {
    /// Its shape. A plane is the half space opposite to its normal.
    pub solid: Solid,
    /// Its centre; of a plane a point on it \[length\].
    pub position: DVec3,
    /// Whether particles are removed outside of the shape instead of inside.
    pub outside: bool,
    /// The species that it removes; `None`: all. Fixed particles are never removed.
    pub species: Option<u32>,
}

/// Words of a birth in the table that `shaders/life/spawn.wgsl` reads.
const WORDS: usize = 8;

/// That table, one `Birth` of the shader after another.
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
