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

/// A particle that forces do not move. At the start of each step it gets the velocity that brings it, along a straight line,
/// to its prescribed position at the end of the step, with every integrator. Motions refer to its position at the start of the
/// run: writing its position later does not change that. Its own initial velocity is ignored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Held {
    /// Its id.
    pub id: u32,
    /// The way in which it moves.
    pub by: Hold,
}

/// The ways in which a particle can move independently of forces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Hold {
    /// Fixed: it does not move, bit for bit.
    Fixed,
    /// Kinematic: it moves to the position in the field [`TARGET`](crate::kernel::TARGET).
    Target,
    /// Kinematic: it follows a motion, by the motion's number.
    Motion(u32),
}

/// These particles in the order of the kernels: fixed, with a target, with a motion; each by id.
#[doc(hidden)]
#[must_use]
pub fn sorted(held: &[Held]) -> Vec<Held> {
    let mut held = held.to_vec();
    held.sort_unstable_by_key(|one| (one.by, one.id));
    held
}

/// A rigid motion by keyframes: x(t) = c + s(t) + R(t) (x₀ − c). Before the first key and after the last it rests. Between two keys the
/// shift s is linear, and the rotation R has one axis and a constant rate (Shoemake 1985), along the shortest path; or, where the two
/// rotation vectors are parallel, through the angle between them, which may be several turns.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Motion {
    /// Its name in scenes and obstacles.
    pub name: String,
    /// c, the centre of rotation \[length\].
    pub about: DVec3,
    /// At least one, in the order of their times.
    pub keys: Vec<Keyframe>,
    /// Whether it is smooth at each key, by u² (3 − 2 u); otherwise it moves at constant speed between keys.
    pub smooth: bool,
    /// Whether it repeats from the first key after the last. The two must be the same pose.
    pub repeat: bool,
}

/// The pose of a motion at a time.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Keyframe {
    /// The time \[time\].
    pub time: f64,
    /// The displacement \[length\].
    pub shift: DVec3,
    /// The rotation vector \[radians\].
    pub turn: DVec3,
}
