//! The pose of a motion, in f64: the reference of `shaders/motion/pose.wgsl`.

use glam::{DQuat, DVec3};

use super::{Keyframe, Motion};

/// The pose of a rigid motion at a time, and its rates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pose {
    /// s \[length\].
    pub shift: DVec3,
    /// R.
    pub turn: DQuat,
    /// ds/dt \[length / time\].
    pub velocity: DVec3,
    /// The angular velocity \[1 / time\].
    pub spin: DVec3,
}

impl Default for Pose {
    /// At rest without displacement.
    fn default() -> Self {
        Self { shift: DVec3::ZERO, turn: DQuat::IDENTITY, velocity: DVec3::ZERO, spin: DVec3::ZERO }
    }
}

/// Two rotation vectors count as parallel below this sine of their angle.
const PARALLEL: f64 = 1e-9;

/// The rotation vector from one key to the next.
pub(super) fn turn(from: &Keyframe, to: &Keyframe) -> DVec3 {
    let (a, b) = (from.turn, to.turn);
    if a.cross(b).length() <= PARALLEL * a.length() * b.length() {
        return b - a;
    }
    let way = DQuat::from_scaled_axis(b) * DQuat::from_scaled_axis(a).inverse();
    let shortest = if way.w < 0.0 { -way } else { way };
    shortest.to_scaled_axis()
}

impl Motion {
    /// The pose at a time. Without keys it rests without displacement.
    #[must_use]
    pub fn pose(&self, time: f64) -> Pose {
        let (Some(first), Some(last)) = (self.keys.first(), self.keys.last()) else { return Pose::default() };
        let period = last.time - first.time;
        let again = self.repeat && time > first.time && period > 0.0;
        let time = if again { first.time + (time - first.time).rem_euclid(period) } else { time };
        let place = self.keys.partition_point(|key| key.time <= time).saturating_sub(1);
        let key = self.keys[place];
        let next = self.keys.get(place + 1).copied().unwrap_or(Keyframe { time: key.time + 1.0, ..key });
        let length = next.time - key.time;
        let u = (time - key.time) / length;
        let part = u.clamp(0.0, 1.0);
        let (part, rate) = if self.smooth {
            (part * part * (3.0 - 2.0 * part), 6.0 * part * (1.0 - part))
        } else {
            (part, if u >= 0.0 { 1.0 } else { 0.0 })
        };
        let (way, turn) = (next.shift - key.shift, turn(&key, &next));
        Pose {
            shift: key.shift + part * way,
            turn: DQuat::from_scaled_axis(part * turn) * DQuat::from_scaled_axis(key.turn),
            velocity: rate / length * way,
            spin: rate / length * turn,
        }
    }
    /// The position of a point at a time, by its initial position.
    #[must_use]
    pub fn place(&self, home: DVec3, time: f64) -> DVec3 {
        let pose = self.pose(time);
        home + pose.shift + (pose.turn * (home - self.about) - (home - self.about))
    }
}
