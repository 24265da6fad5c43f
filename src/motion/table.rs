//! Motions and fixed particles as tables of words, for kernels.

use std::sync::Arc;

use glam::{DQuat, DVec3};

use super::{Held, Hold, Keyframe, Motion, pose};

/// The tables of `shaders/motion/pose.wgsl`, whose structs define the words. They are never empty, because an empty buffer cannot be bound.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Tables {
    /// Words of the motions.
    pub motions: Arc<Vec<u32>>,
    /// Words of their keys.
    pub keys: Arc<Vec<u32>>,
    /// The numbers of motions and of keys.
    pub sizes: [u64; 2],
}

#[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is what the device does")]
fn bits(x: f64) -> u32 {
    (x as f32).to_bits()
}

/// Whole steps, and the remaining part of one.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "motions are checked to fit")]
fn split(steps: f64) -> (u32, f64) {
    (steps.floor() as u32, steps - steps.floor())
}

/// The tables of some motions in steps of `dt`.
#[must_use]
pub fn tables(motions: &[Motion], dt: f64) -> Tables {
    let (mut rows, mut keys) = (Vec::new(), Vec::new());
    let rest = [Motion { keys: vec![Keyframe::default()], ..Motion::default() }];
    let motions = if motions.is_empty() { &rest } else { motions };
    for motion in motions {
        let (Some(first), Some(last)) = (motion.keys.first(), motion.keys.last()) else { continue };
        let number = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        // A start before the run is a negative number of steps.
        let whole = (first.time / dt).floor();
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "the sign comes back on the device"
        )]
        let start = whole as i64 as u32;
        let period = if motion.repeat { (last.time - first.time) / dt } else { 0.0 };
        let (period, period_rest) = split(period);
        let about = motion.about.to_array().map(bits);
        rows.extend([about[0], about[1], about[2], start, bits(first.time / dt - whole)]);
        rows.extend([number(keys.len() / KEY_WORDS), number(motion.keys.len()), u32::from(motion.smooth)]);
        rows.extend([period, bits(period_rest), 0, 0]);
        for (place, key) in motion.keys.iter().enumerate() {
            keys.extend(row(key, motion.keys.get(place + 1), first.time, dt));
        }
    }
    let sizes = [rows.len() as u64 / 12, (keys.len() / KEY_WORDS) as u64];
    Tables { motions: Arc::new(rows), keys: Arc::new(keys), sizes }
}

const KEY_WORDS: usize = 20;

fn row(key: &Keyframe, next: Option<&Keyframe>, start: f64, dt: f64) -> [u32; KEY_WORDS] {
    // After the last key nothing moves, for any length of time.
    let (length, way, turn) = next.map_or((1.0, DVec3::ZERO, DVec3::ZERO), |n| {
        ((n.time - key.time) / dt, n.shift - key.shift, pose::turn(key, n))
    });
    let (step, rest) = split((key.time - start) / dt);
    let facing = DQuat::from_scaled_axis(key.turn).to_array().map(bits);
    let (shift, way) = (key.shift.to_array().map(bits), way.to_array().map(bits));
    let axis = turn.normalize_or_zero().to_array().map(bits);
    let [length, rest, turns] = [length, rest, turn.length() / std::f64::consts::TAU].map(bits);
    let mut words = [0; KEY_WORDS];
    words[..4].copy_from_slice(&facing);
    words[4..8].copy_from_slice(&[shift[0], shift[1], shift[2], length]);
    words[8..12].copy_from_slice(&[way[0], way[1], way[2], rest]);
    words[12..16].copy_from_slice(&[axis[0], axis[1], axis[2], turns]);
    words[16] = step;
    words
}

/// One word for each particle: 1 if it is fixed, otherwise 0.
#[must_use]
pub fn mask(count: u32, held: &[Held]) -> Vec<u32> {
    let mut mask = vec![0; count as usize];
    for one in held {
        if let Some(word) = mask.get_mut(one.id as usize) {
            *word = 1;
        }
    }
    mask
}

/// Two words for each fixed particle: its id, and the number of its motion, 0 without a motion.
#[must_use]
pub fn list(held: &[Held]) -> Vec<u32> {
    let motion = |by| if let Hold::Motion(number) = by { number } else { 0 };
    held.iter().flat_map(|one| [one.id, motion(one.by)]).collect()
}
