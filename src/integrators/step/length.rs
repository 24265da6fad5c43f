//! Adaptive time steps.

use super::Step;
use crate::error::Error;
use crate::forces::Stage;
use crate::integrators::verbs::{adaptive, radau};
use crate::kernel::Plan;

impl Step<'_> {
    /// Sets the time step from the dt criteria at the end of the previous step; does nothing where dt is fixed.
    pub fn adaptive_step(&mut self) {
        let Some(how) = self.problem.adaptive_step else { return };
        if self.problem.estimates_error {
            self.add(adaptive::next_dt(&how, 0.0, &self.problem));
            return;
        }
        let viscous = self.limits().map(|(_, viscous)| viscous);
        self.add(viscous.and_then(|viscous| adaptive::next_dt(&how, viscous, &self.problem)));
        self.add(adaptive::limiting_particle(&how, &self.problem));
    }
    /// Adds the kernels of the dt criteria for the next step.
    pub(super) fn dt_criteria(&mut self) {
        if self.problem.adaptive_step.is_none() {
            return;
        }
        if self.problem.estimates_error {
            self.limits_itself();
            return;
        }
        if self.moved {
            self.neighbors(|_| true);
        }
        match self.limits() {
            Ok((plan, _)) => self.append(plan),
            Err(error) => {
                self.error.get_or_insert(error);
            }
        }
        self.add(adaptive::measure(&self.problem));
    }
    /// Adds the limit by the integrator's own error, which is the only one.
    fn limits_itself(&mut self) {
        if let Some(force) = self.forces.iter().find(|force| force.properties().limits_steps) {
            let text = format!(
                "the integrator chooses its steps by its own error, and {} limits them too: choose leapfrog, or a fixed dt",
                force.name()
            );
            self.error.get_or_insert(Error::Scene(text));
        }
        self.add(radau::criterion(&self.problem));
    }
    /// The kernels of the criteria, and the number of steps per longest step that viscosity requires.
    fn limits(&self) -> Result<(Plan, f64), Error> {
        let mut plan = Plan::default();
        let mut offered = Vec::new();
        for force in self.forces {
            force.stage(Stage::StepLimit, &mut plan, &self.problem)?;
            offered.extend(force.resolved(&self.problem)?.viscous_steps);
        }
        match offered[..] {
            [viscous] => Ok((plan, viscous)),
            [] => Err(Error::Scene(
                "no force limits the time step, so it cannot be adaptive: give a fixed dt, add a fluid, or choose gauss_radau".to_owned(),
            )),
            _ => Err(Error::Scene(format!(
                "{} forces limit the time step, and only one may: give a fixed dt, or leave only one fluid",
                offered.len()
            ))),
        }
    }
}
