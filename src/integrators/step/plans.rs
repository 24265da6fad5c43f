//! The plans that come of what an integrator has written.

use super::Step;
use crate::error::Error;
use crate::forces::{Component, Problem, Stage};
use crate::integrators::verbs::{adaptive, at, keep, life, tick, watch};
use crate::kernel::{Kernel, Plan};
use crate::tree::Opening;

impl<'a> Step<'a> {
    /// The plan of what is done once: what the integrator wrote, and a look for numbers that are broken from the start,
    /// while they are those of the particles at fault. A step spreads them: every particle attracts all others.
    ///
    /// # Errors
    /// The first thing that went wrong while it was written.
    pub fn begun(mut self) -> Result<Plan, Error> {
        if !self.evaluated {
            self.evaluate();
        }
        // The relative opening criterion needs accelerations of an evaluation before.
        if self.looks_back() {
            self.evaluate();
        }
        self.dt_criteria();
        self.add(watch::kernel(self.problem.capacity));
        self.watch_pairs();
        self.finished()
    }
    /// Whether an evaluation depends on the accelerations of the one before.
    fn looks_back(&self) -> bool {
        let mut laws = self.forces.iter().flat_map(|force| force.laws());
        laws.any(|law| law.tree(&self.problem).is_some_and(|tree| matches!(tree.opening, Opening::Relative { .. })))
    }
    /// The plan of one step: what the integrator wrote, the clock's tick, births and deaths, and a look for broken numbers.
    ///
    /// # Errors
    /// The first thing that went wrong while the step was written.
    pub fn done(mut self) -> Result<Plan, Error> {
        self.each(Stage::EndOfStep);
        self.add(if self.problem.adaptive_step.is_some() { adaptive::tick(&self.problem) } else { tick::kernel() });
        self.populate();
        // Particles just spawned take part in the criterion for their first step.
        self.dt_criteria();
        self.add(watch::kernel(self.problem.capacity));
        self.watch_pairs();
        self.finished()
    }
    /// The plan without tick and watch.
    ///
    /// # Errors
    /// The first thing that went wrong while the step was written.
    pub fn finished(mut self) -> Result<Plan, Error> {
        self.flush();
        // Where nothing asks for the time within a step, nothing need set it.
        // By what they run, not by what they are called: a force may be called anything.
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
    /// What time it is, on a clock that has just been set.
    ///
    /// # Errors
    /// When a shader does not compile.
    pub fn time(problem: &Problem) -> Result<Plan, Error> {
        let kernel = if problem.adaptive_step.is_some() { adaptive::at(0.0, problem) } else { at::kernel(0.0) };
        Ok(Plan::of(vec![kernel?]))
    }
    /// The two plans around a measurement: the first keeps the forces that the next step is going to use and evaluates
    /// them at the present state; the second puts the kept ones back.
    ///
    /// # Errors
    /// The first thing that went wrong while they were written.
    pub fn measurement(forces: &'a [Box<dyn Component>], problem: Problem) -> Result<(Plan, Plan), Error> {
        let mut before = Self::keeps(forces, problem.clone());
        before.evaluate();
        let mut after = Self::new(forces, problem);
        after.add(keep::restore(after.problem.capacity));
        after.keep_rates(true);
        Ok((before.finished()?, after.finished()?))
    }
    /// The plan that keeps what the next step is going to use, and evaluates nothing.
    ///
    /// # Errors
    /// The first thing that went wrong while it was written.
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
