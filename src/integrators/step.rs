//! A step as it is being written: each verb adds kernels to a plan.

mod paces;
mod search;
mod solve;

pub use solve::{Explicit, Form, Implicit, implicit};

use std::sync::Arc;

use glam::DVec4;

use super::verbs::{at, clear, drift, held, keep, kick, kick_drift, life, pace, runge_kutta, tick, watch};
use crate::boundary;
use crate::error::Error;
use crate::forces::{Component, Problem, Stage};
use crate::kernel::{ACCELERATION, Kernel, Plan, Twin};
use crate::tree::Opening;

/// Writes a plan in verbs. The first error is kept and given at the end, so that an integrator reads like its textbook.
pub struct Step<'a> {
    forces: &'a [Box<dyn Component>],
    problem: Problem,
    plan: Plan,
    evaluated: bool,
    /// Whether positions have changed since neighbours were found.
    moved: bool,
    /// How much of the step positions have been advanced by.
    drifted: f64,
    /// A kick that a drift may follow: the two are one dispatch then.
    kicked: Option<f64>,
    /// Whether every kernel stays alone.
    apart: bool,
    error: Option<Error>,
}

impl<'a> Step<'a> {
    /// An empty step of particles under some forces.
    #[must_use]
    pub fn new(forces: &'a [Box<dyn Component>], problem: Problem) -> Self {
        Self {
            forces,
            problem,
            plan: Plan::default(),
            evaluated: false,
            moved: false,
            drifted: 0.0,
            kicked: None,
            apart: false,
            error: None,
        }
    }

    /// a ← forces(x, v, t), with all laws in the order of the scene.
    pub fn evaluate(&mut self) {
        let mut laws = self.laws(|_| true);
        // The first law need not add to what has been cleared.
        if self.apart || !laws.first_mut().is_some_and(begins) {
            self.clear();
        }
        self.felt(laws);
    }
    /// From here on every kernel is a dispatch of its own: to see what it is worth to join them.
    pub fn apart(&mut self) {
        self.apart = true;
    }
    /// No acceleration yet.
    fn clear(&mut self) {
        self.add(clear::kernel(self.problem.count));
    }
    /// Adds what some of the forces say, chosen by their places.
    fn gather(&mut self, chosen: impl Fn(usize) -> bool) {
        let laws = self.laws(chosen);
        self.felt(laws);
    }
    /// The kernels of the laws of some forces, behind the grids that they search.
    fn laws(&mut self, chosen: impl Fn(usize) -> bool) -> Vec<Kernel> {
        self.flush();
        self.evaluated = true;
        self.moved = false;
        self.neighbors(&chosen);
        let mut laws = Plan::default();
        let name = |force: &dyn Component| force.laws().first().map(|law| law.name.clone());
        let all = || self.forces.iter().enumerate().filter(|(place, _)| chosen(*place));
        let last = |force: &Box<dyn Component>| force.properties().evaluated_last;
        let ordered = all().filter(|(_, force)| !last(*force)).chain(all().filter(|(_, force)| last(*force)));
        for (place, force) in ordered {
            // Two forces of one kind are two kernels.
            let earlier =
                self.forces[..place].iter().filter(|other| name(other.as_ref()) == name(force.as_ref())).count();
            if self.error.is_none() {
                self.error = force.stage(Stage::Evaluate { earlier }, &mut laws, &self.problem).err();
            }
        }
        laws.steps().cloned().collect()
    }
    /// Adds the kernels of laws; who is held feels nothing.
    fn felt(&mut self, laws: Vec<Kernel>) {
        for kernel in laws {
            self.add(Ok(kernel));
        }
        if !self.problem.held.is_empty() {
            self.add(held::hold(&self.problem));
        }
        if self.problem.mortal {
            self.add_all(life::still(&self.problem));
        }
    }
    /// Who is held gets the velocity that brings it where it shall be at the end of the step.
    pub fn lead(&mut self) {
        self.add_all(held::lead(&self.problem));
    }
    /// Who is due is born, and who is in a drain dies.
    pub fn populate(&mut self) {
        self.moved |= self.problem.mortal;
        self.add_all(life::kernels(&self.problem));
    }
    /// What forces do once, before the first step.
    pub fn begin(&mut self) {
        self.each(Stage::Start);
    }
    /// v ← v + c a dt, within the limits of speed
    pub fn kick(&mut self, factor: f64) {
        self.flush();
        self.kicked = Some(factor);
        self.limit();
    }
    /// x ← x + c v dt, and back into the box
    pub fn drift(&mut self, factor: f64) {
        let count = self.problem.count;
        match self.kicked.take_if(|_| !self.apart) {
            Some(kick) => self.add(kick_drift::kernel(count, kick, factor)),
            None => self.add(drift::kernel(count, factor)),
        }
        self.enclose();
        self.drifted += factor;
        self.confine(factor);
    }
    /// Whoever has left the box by a closed side comes in again.
    pub fn enclose(&mut self) {
        self.moved = true;
        self.add_all(boundary::kernels(&self.problem));
    }
    /// Forces are evaluated at t + c dt from here on, until the end of the step.
    pub fn at(&mut self, factor: f64) {
        let kernel = match self.problem.pace {
            Some(_) => pace::at(factor, &self.problem),
            None => at::kernel(factor),
        };
        self.add(kernel);
    }
    /// Keeps where the step starts, x₀ and v₀.
    pub fn save(&mut self) {
        self.add(runge_kutta::save(self.problem.count));
    }
    /// Adds `weight` times the slopes (v, a) to their sum, and goes on to x₀ + c v dt, v₀ + c a dt.
    pub fn stage(&mut self, weight: f64, factor: f64) {
        self.moved = true;
        self.add(runge_kutta::stage(self.problem.count, weight, factor));
    }
    /// Adds the last slopes with `weight`, and goes from x₀, v₀ the whole step with the weighted sum, and back into the
    /// box. Stages may leave it: forces see the nearest images from there too.
    pub fn finish(&mut self, weight: f64) {
        self.add(runge_kutta::finish(self.problem.count, weight));
        self.limit();
        self.enclose();
        self.drifted = 1.0;
        self.problem.reached = self.drifted;
        self.each(Stage::AfterAdvance { factor: 1.0 });
    }

    /// The plan of what is done once: what the integrator wrote, and a look for numbers that are broken from the start,
    /// while they are those of the particles at fault. A step spreads them: everybody attracts everybody.
    ///
    /// # Errors
    /// The first thing that went wrong while it was written.
    pub fn begun(mut self) -> Result<Plan, Error> {
        if !self.evaluated {
            self.evaluate();
        }
        // Who opens groups by what was felt last, has felt something then.
        if self.looks_back() {
            self.evaluate();
        }
        self.urge();
        self.add(watch::kernel(self.problem.count));
        self.finished()
    }
    /// Whether what is felt depends on what was felt last.
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
        self.add(if self.problem.pace.is_some() { pace::tick(&self.problem) } else { tick::kernel() });
        self.populate();
        // Who has just been born has a say in the length of its first step.
        self.urge();
        self.add(watch::kernel(self.problem.count));
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
            ![tick::NAME, life::BEAR].into_iter().any(|entry| runs(kernel, entry))
                && kernel.passes.iter().any(|p| p.shader.reflection().reads_time)
        };
        let within: Vec<_> = self.plan.kernels.iter().map(|k| runs(k, at::NAME)).collect();
        if !self.plan.kernels.iter().zip(&within).any(|(kernel, at)| !at && asked(kernel)) {
            self.plan.order.retain(|index| !within.get(*index).is_some_and(|at| *at));
        }
        self.error.map_or(Ok(self.plan), Err)
    }
    /// The two plans around a measurement: the first keeps the forces that the next step is going to use and evaluates
    /// them at the present state; the second puts the kept ones back.
    ///
    /// # Errors
    /// The first thing that went wrong while they were written.
    pub fn measurement(forces: &'a [Box<dyn Component>], problem: Problem) -> Result<(Plan, Plan), Error> {
        let count = problem.count;
        let mut before = Self::new(forces, problem.clone());
        before.add(keep::keep(count));
        before.evaluate();
        let mut after = Self::new(forces, problem);
        after.add(keep::restore(count));
        Ok((before.finished()?, after.finished()?))
    }

    /// What forces make of positions that are not allowed, after an advance by a part of the step.
    fn confine(&mut self, factor: f64) {
        self.problem.reached = self.drifted;
        self.each(Stage::AfterDrift { factor });
    }
    /// What forces make of velocities that are not allowed.
    fn limit(&mut self) {
        self.each(Stage::AfterKick);
    }
    /// What all components do at a stage.
    fn each(&mut self, stage: Stage) {
        let mut plan = Plan::default();
        // Rods have the last word, wherever a scene names them: what moves one end after them stretches them.
        let (rods, others): (Vec<_>, Vec<_>) = self.forces.iter().partition(|force| force.properties().keeps_rods);
        for force in others.into_iter().chain(rods) {
            if self.error.is_none() {
                self.error = force.stage(stage, &mut plan, &self.problem).err();
            }
        }
        plan.steps().for_each(|kernel| self.add(Ok(kernel.clone())));
    }
    /// A kick that no drift has taken up is a dispatch of its own.
    fn flush(&mut self) {
        if let Some(factor) = self.kicked.take() {
            self.add(kick::kernel(self.problem.count, factor));
        }
    }
    fn add_all(&mut self, kernels: Result<Vec<Kernel>, Error>) {
        match kernels {
            Ok(kernels) => kernels.into_iter().for_each(|kernel| self.add(Ok(kernel))),
            Err(error) => {
                self.error.get_or_insert(error);
            }
        }
    }
    fn add(&mut self, kernel: Result<Kernel, Error>) {
        self.flush();
        match kernel {
            Ok(kernel) => self.plan.add(kernel),
            Err(error) => {
                self.error.get_or_insert(error);
            }
        }
    }
}

/// Makes a kernel the first to say what is felt, if it can be: it sets accelerations instead of adding to them.
fn begins(law: &mut Kernel) -> bool {
    const FIRST: &str = "FIRST";
    let can = law.passes.len() == 1 && law.passes[0].shader.reflection().overrides.contains_key(FIRST);
    if can {
        law.passes[0].constants.push((FIRST, 1.0));
        let adds = law.twin.take();
        law.twin = adds.map(|adds| -> Twin {
            Arc::new(move |host| {
                host.write(ACCELERATION)?.fill(DVec4::ZERO);
                adds(host)
            })
        });
    }
    can
}
