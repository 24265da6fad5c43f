//! Balls where particles are few or large, else lights.

use super::{Style, Subject};
use crate::render::frame::NEVER;

/// `auto`
pub struct Auto;

impl Style for Auto {
    fn marker(&self, of: &Subject) -> f64 {
        if of.few { few(of) } else { 0.0 }
    }
    /// A picture in which like particles are balls here and lights there, as they are near or far, is no good: where the usual size
    /// is enough for balls, all that have one are.
    fn solid(&self, of: &Subject) -> f64 {
        let mut sizes: Vec<f64> = of.particles.size().iter().copied().filter(|radius| *radius > 0.0).collect();
        if of.few {
            return 0.5;
        }
        let middle = sizes.len() / 2;
        if sizes.is_empty() {
            return NEVER;
        }
        let usual = *sizes.select_nth_unstable_by(middle, f64::total_cmp).1 * of.scale;
        if usual > 2.0 { 0.5 } else { 5.0 }
    }
}

/// The radius of the heaviest of few.
pub fn few(of: &Subject) -> f64 {
    0.025 * of.short / (1.0 + of.particles.len() as f64 / 16.0)
}
