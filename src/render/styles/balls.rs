//! Shaded balls.

use super::{Style, Subject, auto};

/// `balls`
pub struct Balls;

impl Style for Balls {
    fn marker(&self, of: &Subject) -> f64 {
        if of.few {
            return auto::few(of);
        }
        // What has no size of its own is as large as it is seen apart from others.
        let sizeless = of.particles.size().iter().all(|radius| *radius <= 0.0);
        if sizeless { (0.25 * of.apart).clamp(1.0, (of.short / 150.0).max(1.0)) } else { 1.0 }
    }
    fn solid(&self, _: &Subject) -> f64 {
        0.0
    }
}
