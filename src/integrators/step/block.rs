//! A step with block time steps.

use super::Step;
use crate::error::Error;
use crate::integrators::verbs::block;
use crate::kernel::{BLOCK_CLOCK, Pass};

impl Step<'_> {
    /// A step in parts, each as long as the shortest step of any particle: kicks at the ends of particles' own steps, drifts of all.
    /// Forces are evaluated of those that are kicked.
    pub fn block_steps(&mut self) {
        let Some(steps) = self.problem.block_steps else { return };
        self.add(block::begin(&self.problem));
        let before = std::mem::take(&mut self.plan);
        self.in_parts = true;
        self.add(block::level(steps, &self.problem));
        self.add(block::advance(steps, &self.problem));
        self.add(block::kick_drift(steps, &self.problem));
        self.enclose();
        self.evaluate();
        self.add(block::kick(steps, &self.problem));
        self.in_parts = false;
        let body = std::mem::replace(&mut self.plan, before);
        let loose = body.steps().find(|kernel| kernel.passes.iter().any(is_loose)).map(|kernel| kernel.name.clone());
        if let Some(name) = loose {
            self.refuse(&format!("`{name}` runs only when it must, and cannot do so within a step"));
        }
        if let Err(error) = self.plan.repeat(steps.whole(), BLOCK_CLOCK.name, 0, "done", body) {
            self.error.get_or_insert(error);
        }
        self.add(block::end(&self.problem));
        self.drifted = 1.0;
    }
    /// Outside of the parts of a step, forces of all particles are evaluated.
    pub(super) fn due(&mut self) {
        if self.problem.block_steps.is_some() && !self.in_parts {
            self.add(block::begin(&self.problem));
        }
    }
    fn refuse(&mut self, why: &str) {
        let text = format!("block time steps are for forces alone: {why}; leave it out, or leave block_levels out");
        self.error.get_or_insert(Error::Scene(text));
    }
}

/// Whether a pass depends on a count that is not zero after its kernel: in a loop it would run once more.
fn is_loose(pass: &Pass) -> bool {
    pass.indirect.as_ref().is_some_and(|indirect| !indirect.rests)
}
