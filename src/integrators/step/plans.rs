//! The plans made from the kernels that an integrator has written.

use super::Step;
use crate::component::{barostat, pressure};
use crate::error::Error;
use crate::forces::{Component, Problem, Stage};
use crate::integrators::verbs::{adaptive, at, keep, life, tick, watch};
use crate::kernel::{Kernel, Plan};

impl<'a> Step<'a> {
    /// The start plan: the integrator's kernels, and a check for numbers that are not finite at the start, while only the particles at
    /// fault have them. A step spreads them: every particle attracts all others.
    ///
    /// # Errors
    /// The first error of writing it.
    pub fn begun(mut self) -> Result<Plan, Error> {
        if !self.evaluated {
            self.evaluate();
        }
        // The relative opening criterion needs the accelerations of a previous evaluation.
        if self.looks_back() {
            self.evaluate();
        }
        self.dt_criteria();
        self.watch(0);
        self.finished()
    }
    /// Checks for numbers that are not finite, before the last steps, `ahead`, are counted.
    fn watch(&mut self, ahead: u32) {
        self.add(watch::kernel(&self.problem, ahead));
        self.watch_pairs(ahead);
    }
    /// Whether an evaluation depends on the accelerations of the previous one.
    fn looks_back(&self) -> bool {
        let mut laws = self.forces.iter().flat_map(|force| force.laws());
        laws.any(|law| law.tree(&self.problem).is_some_and(|tree| tree.opening.is_relative()))
    }
    /// The plan of one step: the integrator's kernels, a check for numbers that are not finite, the step counter, spawns and drains.
    ///
    /// # Errors
    /// The first error of writing it.
    pub fn done(mut self) -> Result<Plan, Error> {
        self.each(Stage::EndOfStep);
        self.pressure();
        // Beside the last kick, with which it can be one dispatch; but after what is born and removed, and a step that may have no length.
        let last = self.problem.has_inactive || self.problem.adaptive_step.is_some();
        if !last {
            self.watch(1);
        }
        self.add(if self.problem.adaptive_step.is_some() { adaptive::tick(&self.problem) } else { tick::kernel() });
        self.populate();
        // Particles just spawned take part in the criterion for their first step.
        self.dt_criteria();
        if last {
            self.watch(0);
        }
        self.finished()
    }
    /// Adds the measurement of the pressure, and what follows from it, where a component needs it.
    fn pressure(&mut self) {
        if let Some(pressed) = self.forces.iter().find_map(|force| force.properties().barostat) {
            self.add(pressure::kernel(self.forces, &self.problem, pressed.every));
            self.each(Stage::Pressure);
        }
    }
    /// The plan without step counter and check.
    ///
    /// # Errors
    /// The first error of writing it.
    pub fn finished(mut self) -> Result<Plan, Error> {
        self.flush();
        // Kernels that set the time are left out where no kernel reads it.
        // They are found by their entry points, since a force may have any name.
        let runs = |kernel: &Kernel, entry| kernel.passes.iter().all(|p| p.shader.reflection().entry == entry);
        let asked = |kernel: &Kernel| {
            ![tick::NAME, life::SPAWN].into_iter().any(|entry| runs(kernel, entry))
                && kernel.passes.iter().any(|p| p.shader.reflection().reads_time)
        };
        if !self.plan.kernels.iter().any(|kernel| !runs(kernel, at::NAME) && asked(kernel)) {
            self.plan.retain(|kernel| !runs(kernel, at::NAME));
        }
        self.error.map_or(Ok(self.plan), Err)
    }
    /// Sets the time, after the clock was set.
    ///
    /// # Errors
    /// When a shader does not compile.
    pub fn time(problem: &Problem) -> Result<Plan, Error> {
        let kernel = if problem.adaptive_step.is_some() { adaptive::at(0.0, problem) } else { at::kernel(0.0) };
        let mut step = Self::new(&[], problem.clone());
        step.prove();
        step.add(kernel);
        if problem.elastic.is_some() {
            step.add(barostat::advance(problem, false));
        }
        step.error.map_or(Ok(step.plan), Err)
    }
    /// The two plans around a measurement: the first saves the forces that the next step uses and evaluates them at the present state; the
    /// second restores the saved ones.
    ///
    /// # Errors
    /// The first error of writing them.
    pub fn measurement(forces: &'a [Box<dyn Component>], problem: Problem) -> Result<(Plan, Plan), Error> {
        let mut before = Self::keeps(forces, problem.clone());
        before.evaluate();
        let mut after = Self::new(forces, problem);
        after.add(keep::restore(after.problem.capacity));
        after.keep_rates(true);
        Ok((before.finished()?, after.finished()?))
    }
    /// The plan that saves the data that the next step uses, without an evaluation.
    ///
    /// # Errors
    /// The first error of writing it.
    pub fn keeping(forces: &'a [Box<dyn Component>], problem: Problem) -> Result<Plan, Error> {
        Self::keeps(forces, problem).finished()
    }
    fn keeps(forces: &'a [Box<dyn Component>], problem: Problem) -> Self {
        let mut step = Self::new(forces, problem);
        step.add(keep::keep(step.problem.capacity));
        step.keep_rates(false);
        step
    }
}
