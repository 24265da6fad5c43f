//! Validation of motions and fixed particles.

use std::collections::BTreeSet;

use glam::{DQuat, DVec3};

use super::{Held, Hold, Keyframe, Motion};
use crate::error::Error;

/// The steps between two times of a motion are counted with a sign, in 32 bits.
const MOST_STEPS: f64 = 2e9;
/// The tolerated difference of the first and the last pose of a motion that repeats, for degrees with a few digits.
const SAME: f64 = 1e-6;

/// Checks motions and fixed particles, for `count` particles in `dimensions` dimensions and steps of `dt`.
///
/// # Errors
/// [`Error::Scene`] that names the first invalid motion or particle.
pub fn check(held: &[Held], motions: &[Motion], count: usize, dimensions: u32, dt: f64) -> Result<(), Error> {
    let mut names = BTreeSet::new();
    for motion in motions {
        motion.check(dimensions, dt).map_err(|why| Error::Scene(format!("the motion \"{}\" {why}", motion.name)))?;
        if !names.insert(&motion.name) {
            return Err(Error::Scene(format!("two motions are called \"{}\": rename one of them", motion.name)));
        }
    }
    let mut ids = BTreeSet::new();
    for one in held {
        let id = one.id;
        if id as usize >= count {
            return Err(Error::Scene(format!(
                "particle {id} is fixed, but there are {count} particles: ids start at 0"
            )));
        }
        if !ids.insert(id) {
            return Err(Error::Scene(format!("particle {id} is fixed twice: list it once")));
        }
        if let Hold::Motion(number) = one.by
            && number as usize >= motions.len()
        {
            let have = motions.len();
            return Err(Error::Scene(format!(
                "particle {id} follows motion {number}, but there are {have} motions: numbers start at 0"
            )));
        }
    }
    Ok(())
}

impl Motion {
    fn check(&self, dimensions: u32, dt: f64) -> Result<(), String> {
        let fits = |v: DVec3| v.to_array().into_iter().all(|x| x.abs() <= f64::from(f32::MAX));
        let (Some(first), Some(last)) = (self.keys.first(), self.keys.last()) else {
            return Err("has no keyframes: give it at least one".to_owned());
        };
        if !fits(self.about) {
            return Err(format!("rotates by {}: these must be finite numbers that fit single precision", self.about));
        }
        for key in &self.keys {
            if !(key.time.is_finite() && fits(key.shift) && fits(key.turn)) {
                return Err("has a keyframe with a number that is NaN, infinite or beyond single precision".to_owned());
            }
            if (key.time / dt).abs() > MOST_STEPS {
                return Err(format!(
                    "has a keyframe at {:?}, more than {MOST_STEPS:e} steps away: choose another time",
                    key.time
                ));
            }
            let across = key.shift.z != 0.0 || key.turn.x != 0.0 || key.turn.y != 0.0;
            if dimensions == 2 && across {
                return Err("leaves the plane, which is impossible in 2 dimensions: shift along x and y, turn about z"
                    .to_owned());
            }
        }
        if let Some(pair) = self.keys.windows(2).find(|pair| pair[1].time <= pair[0].time) {
            return Err(format!(
                "has a keyframe at {} after one at {}: times must increase",
                pair[1].time, pair[0].time
            ));
        }
        if self.repeat {
            let period = last.time - first.time;
            if period < dt {
                return Err(format!("repeats after {period}, which is less than a step of {dt}: make it longer"));
            }
            if !same(first, last) {
                return Err(
                    "repeats, and its last keyframe differs from its first: it would jump; make them equal".to_owned()
                );
            }
        }
        Ok(())
    }
}

fn same(a: &Keyframe, b: &Keyframe) -> bool {
    let turned = |key: &Keyframe| DQuat::from_scaled_axis(key.turn);
    let size = a.shift.length().max(b.shift.length());
    let apart = 1.0 - turned(a).dot(turned(b)).abs();
    (a.shift - b.shift).length() <= SAME * size && apart <= SAME * SAME + 4.0 * f64::EPSILON
}
