//! Prescribed motions: fixed and kinematic particles, on which forces do not act.

mod check;
mod pose;
mod table;

use glam::DVec3;

#[doc(hidden)]
pub use check::check;
pub use pose::Pose;
#[doc(hidden)]
pub use table::{Tables, list, mask, tables};

/// A particle that forces do not move. At the start of each step it gets the velocity that brings it, on a straight line,
/// to where it shall be at the end of the step: so every integrator carries it along, and between two places it passes
/// all that lie in between. Where it is at the start of the run is its home, forever: writing its position later sets no
/// new one. Its own velocity at the start counts for nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Held {
    /// Its id.
    pub id: u32,
    /// What it does instead.
    pub by: Hold,
}

/// What a particle does that forces do not move.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Hold {
    /// It stays where it is, bit for bit.
    Fixed,
    /// It goes where the field [`TARGET`](crate::kernel::TARGET) says.
    Target,
    /// It goes along with a motion, by the motion's number.
    Motion(u32),
}

/// The same ones in the order in which kernels take them: fixed, with a target, with a motion; each by id.
#[doc(hidden)]
#[must_use]
pub fn sorted(held: &[Held]) -> Vec<Held> {
    let mut held = held.to_vec();
    held.sort_unstable_by_key(|one| (one.by, one.id));
    held
}

/// A rigid motion by keyframes: x(t) = c + s(t) + R(t) (x₀ − c). Before the first key and after the last it rests.
/// Between two keys the shift s goes straight and the turn R goes about one axis at one rate (Shoemake 1985), the shortest
/// way; or, where two rotation vectors are parallel, as far as they say, which may be several turns.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Motion {
    /// What solids and scenes call it.
    pub name: String,
    /// c, the centre of turning \[length\].
    pub about: DVec3,
    /// At least one, in the order of their times.
    pub keys: Vec<Keyframe>,
    /// Whether it sets off gently from each key, and arrives gently, by u² (3 − 2 u); else it goes at constant speed.
    pub smooth: bool,
    /// Whether it begins again at the first key when it is at the last. The two must be the same pose.
    pub repeat: bool,
}

/// Where a motion is at a time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Keyframe {
    /// The time \[time\].
    pub time: f64,
    /// How far it has moved \[length\].
    pub shift: DVec3,
    /// How far it has turned: a rotation vector \[radians\].
    pub turn: DVec3,
}
