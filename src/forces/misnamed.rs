//! A component whose settings make no sense: an error, wherever a plan is written.

use super::{Component, Problem, Stage};
use crate::error::Error;
use crate::kernel::Plan;

/// A component that cannot be built, and why.
pub struct Misnamed(pub String);

impl Component for Misnamed {
    fn stage(&self, _: Stage, _: &mut Plan, _: &Problem) -> Result<(), Error> {
        Err(Error::Scene(self.0.clone()))
    }
}
