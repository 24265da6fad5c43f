//! The surface of a fluid (van der Laan, Green & Sainz 2009).

use super::{Canvas, Style, Subject};
use crate::error::Error;
use crate::kernel::Plan;
use crate::render::{Picture, passes};

/// `fluid`
pub struct Fluid;

impl Style for Fluid {
    fn solid(&self, _: &Subject) -> f64 {
        0.0
    }
    fn is_fluid(&self) -> bool {
        true
    }
    fn unused(&self) -> &'static [&'static str] {
        &["tail", "size"]
    }
    fn has_trails(&self) -> bool {
        false
    }
    fn light(&self, picture: &Picture, plan: &mut Plan) -> Result<(), Error> {
        passes::fluid(&picture.frame, picture.facets(), plan)
    }
    fn plain(&self, canvas: &mut Canvas) {
        canvas.draw_fluid();
    }
}
