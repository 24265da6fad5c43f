//! A component with invalid settings: an error wherever a plan is written.

use super::{Component, Problem, Stage};
use crate::error::Error;
use crate::kernel::Plan;

/// A component that cannot be built, and the reason.
#[derive(Clone)]
struct Misnamed(String);

/// Such a component.
pub fn misnamed(why: String) -> Box<dyn Component> {
    Box::new(Misnamed(why))
}

impl Component for Misnamed {
    fn stage(&self, _: Stage, _: &mut Plan, _: &Problem) -> Result<(), Error> {
        Err(Error::Scene(self.0.clone()))
    }
}
