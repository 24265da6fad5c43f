//! Shaded balls.

use super::{Style, Subject, auto};

/// `balls`
pub struct Balls;

impl Style for Balls {
    fn marker(&self, of: &Subject) -> f64 {
        if of.few { auto::few(of) } else { 1.0 }
    }
    fn solid(&self, _: &Subject) -> f64 {
        0.0
    }
}
