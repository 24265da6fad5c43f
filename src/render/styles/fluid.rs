//! The surface of a fluid (van der Laan, Green & Sainz 2009).

use super::{Style, Subject};
use crate::error::Error;
use crate::kernel::Plan;
use crate::render::{Picture, drops, foam, settle, water};

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
        &["tail"]
    }
    fn has_trails(&self) -> bool {
        false
    }
    fn light(&self, picture: &Picture, plan: &mut Plan) -> Result<(), Error> {
        let frame = &picture.frame;
        plan.add(foam::kernel(frame)?);
        plan.add(drops::kernel(frame)?);
        plan.add(drops::level(frame)?);
        plan.add(settle::kernel(frame)?);
        plan.add(water::kernel(frame, picture.facets())?);
        Ok(())
    }
}
