//! A step as it is being written: each verb adds kernels to a plan.

mod block;
mod length;
mod pairs;
mod plans;
mod radau;
mod search;
mod solve;

pub use pairs::kept_rates;
pub use solve::{Explicit, Form, Implicit, implicit};

use super::verbs::{adaptive, at, clear, compensated, drift, held, kick, kick_drift, life, runge_kutta};
use crate::boundary;
use crate::component::earlier;
use crate::error::Error;
use crate::forces::{Component, Problem, Stage};
use crate::kernel::{Kernel, Plan};

/// Writes a plan in verbs. The first error is kept and returned at the end, so that an integrator reads like its formula in a textbook.
pub struct Step<'a> {
    forces: &'a [Box<dyn Component>],
    problem: Problem,
    plan: Plan,
    evaluated: bool,
    /// Whether positions have changed since neighbours were found.
    moved: bool,
    /// The part of the step by which positions have been advanced.
    drifted: f64,
    /// The part of the step at which forces are evaluated.
    time: f64,
    /// A kick that is not written yet: with a following drift it becomes one dispatch.
    kicked: Option<f64>,
    /// Whether kernels are never merged.
    apart: bool,
    /// Whether kernels are written for the parts of a step with block time steps.
    in_parts: bool,
    /// Whether slopes are needed, for the stages of a Runge–Kutta step.
    staged: bool,
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
            time: 0.0,
            kicked: None,
            apart: false,
            in_parts: false,
            staged: false,
            error: None,
        }
    }

    /// a ← forces(x, v, t), with all laws in the order of the scene.
    pub fn evaluate(&mut self) {
        let mut laws = self.laws(|_| true);
        // The first law can set the sums that would be cleared.
        if self.apart || !laws.first_mut().is_some_and(clear::with) {
            self.add(clear::kernel(self.problem.capacity));
        }
        self.clear_sums(false);
        self.add_laws(laws);
        if self.staged {
            self.carried_rates();
        }
    }
    /// From here on kernels are not merged: used to measure the gain of merging.
    pub fn apart(&mut self) {
        self.apart = true;
    }
    /// Sets accelerations and other sums to zero.
    fn clear(&mut self) {
        self.add(clear::kernel(self.problem.capacity));
        self.clear_sums(false);
    }
    /// Adds the kernels of some forces, chosen by index.
    fn gather(&mut self, chosen: impl Fn(usize) -> bool) {
        let laws = self.laws(chosen);
        self.add_laws(laws);
    }
    /// The kernels of the laws of some forces, after the grids that they search.
    fn laws(&mut self, chosen: impl Fn(usize) -> bool) -> Plan {
        self.flush();
        self.evaluated = true;
        self.moved = false;
        self.due();
        self.neighbors(&chosen);
        let mut laws = Plan::default();
        let all = || self.forces.iter().enumerate().filter(|(place, _)| chosen(*place));
        let last = |force: &dyn Component| force.properties().evaluated_last;
        let ordered =
            all().filter(|(_, force)| !last(force.as_ref())).chain(all().filter(|(_, force)| last(force.as_ref())));
        let problem = Problem { reached: self.time, ..self.problem.clone() };
        for (place, force) in ordered {
            let earlier = earlier(self.forces, place);
            if self.error.is_none() {
                self.error = force.stage(Stage::Evaluate { earlier }, &mut laws, &problem).err();
            }
        }
        laws
    }
    /// Adds the kernels of laws, after which the accelerations of fixed particles are set to zero.
    fn add_laws(&mut self, laws: Plan) {
        self.append(laws);
        if !self.problem.held.is_empty() {
            self.add(held::hold(&self.problem));
        }
        if self.problem.has_inactive {
            self.add_all(life::still(&self.problem));
        }
    }
    /// Sets the velocities of fixed and kinematic particles such that they reach their positions at the end of the step.
    pub fn lead(&mut self) {
        self.add_all(held::lead(&self.problem));
    }
    /// Particles that are due are spawned, and particles in a drain are removed.
    pub fn populate(&mut self) {
        self.moved |= self.problem.has_inactive;
        self.add_all(life::kernels(&self.problem));
    }
    /// Adds the kernels of forces at the start of a step.
    pub fn open(&mut self) {
        self.each(Stage::StartOfStep);
    }
    /// Adds the proof that sums are compensated, where positions and velocities rely on them.
    pub fn prove(&mut self) {
        if self.problem.precision.is_double() {
            self.add(compensated::prove(compensated::sums()));
        }
    }
    /// Adds the kernels of forces before the first step.
    pub fn begin(&mut self) {
        self.each(Stage::Start);
    }
    /// v ← v + c a dt, within the limits of speed, and every column whose rate is computed by evaluations
    pub fn kick(&mut self, factor: f64) {
        self.flush();
        self.kick_pairs(factor);
        self.kicked = Some(factor);
        self.limit();
    }
    /// A kick by a kernel of the integrator, which changes velocities, within the limits of speed; other columns whose rates are computed
    /// by evaluations are advanced by a part of the step.
    pub fn kick_by(&mut self, kernel: Result<Kernel, Error>, factor: f64) {
        self.kick_pairs(factor);
        self.add(kernel);
        self.limit();
    }
    /// x ← x + c v dt, and back into the box, and every column whose rate is a state; carried columns by their rates in the middle of the
    /// drift
    pub fn drift(&mut self, factor: f64) {
        if self.carries() {
            self.drift_carrying(factor);
        } else {
            self.go(factor);
        }
        self.enclose();
        self.drift_pairs(factor);
        self.drifted += factor;
        self.confine(factor);
    }
    /// x ← x + c v dt
    fn go(&mut self, factor: f64) {
        let count = self.problem.capacity;
        let is_double = self.problem.precision.is_double();
        let kernel = match self.kicked.take_if(|_| !self.apart) {
            Some(kick) if is_double => compensated::kick_drift(&self.problem, kick, factor),
            Some(kick) => kick_drift::kernel(count, kick, factor),
            None if is_double => compensated::drift(&self.problem, factor),
            None => drift::kernel(count, factor),
        };
        self.add(kernel);
    }
    /// Particles that left the box through a periodic or reflecting side are put back.
    pub fn enclose(&mut self) {
        self.moved = true;
        self.add_all(boundary::kernels(&self.problem));
    }
    /// Forces are evaluated at t + c dt from here on, until the end of the step.
    pub fn at(&mut self, factor: f64) {
        self.time = factor;
        let kernel = match self.problem.adaptive_step {
            Some(_) => adaptive::at(factor, &self.problem),
            None => at::kernel(factor),
        };
        self.add(kernel);
    }
    /// Saves the start of the step, x₀ and v₀, and every column that is advanced.
    pub fn save(&mut self) {
        self.staged = true;
        self.add(runge_kutta::save(self.problem.capacity));
        self.save_pairs();
    }
    /// Adds `weight` times the slopes (v, a) to their sum, and continues to x₀ + c v dt, v₀ + c a dt.
    pub fn stage(&mut self, weight: f64, factor: f64) {
        self.moved = true;
        self.slopes();
        self.stage_pairs(true, weight, factor);
        self.add(runge_kutta::stage(self.problem.capacity, weight, factor));
        self.stage_pairs(false, weight, factor);
    }
    /// Adds the last slopes with `weight`, advances from x₀, v₀ by the whole step with the weighted sum, and puts particles back into the
    /// box. Stages may leave it: forces use the nearest images there too.
    pub fn finish(&mut self, weight: f64) {
        self.staged = false;
        self.slopes();
        self.finish_pairs(true, weight);
        self.add(runge_kutta::finish(self.problem.capacity, weight));
        self.finish_pairs(false, weight);
        self.arrive();
    }
    /// Constrains velocities and positions at the end of a step that was made in one.
    fn arrive(&mut self) {
        self.limit();
        self.enclose();
        self.drifted = 1.0;
        self.problem.reached = self.drifted;
        self.each(Stage::AfterAdvance { factor: 1.0 });
    }

    /// Constrains positions, after an advance by a part of the step.
    fn confine(&mut self, factor: f64) {
        self.problem.reached = self.drifted;
        self.each(Stage::AfterDrift { factor });
    }
    /// Constrains velocities.
    fn limit(&mut self) {
        self.each(Stage::AfterKick);
    }
    /// Adds the kernels of all components at a stage.
    fn each(&mut self, stage: Stage) {
        let mut plan = Plan::default();
        // Rods come last, wherever they are in a scene: a later change of one end would stretch them.
        let (rods, others): (Vec<_>, Vec<_>) = self.forces.iter().partition(|force| force.properties().keeps_rods);
        for force in others.into_iter().chain(rods) {
            if self.error.is_none() {
                self.error = force.stage(stage, &mut plan, &self.problem).err();
            }
        }
        self.append(plan);
    }
    /// A kick without a following drift is a dispatch of its own.
    fn flush(&mut self) {
        if let Some(factor) = self.kicked.take() {
            let is_double = self.problem.precision.is_double();
            self.add(if is_double {
                compensated::kick(&self.problem, factor)
            } else {
                kick::kernel(self.problem.capacity, factor)
            });
        }
    }
    fn append(&mut self, plan: Plan) {
        if !plan.is_empty() {
            self.flush();
            self.plan.append(plan);
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
    /// The number of particles.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.problem.capacity
    }
    /// Adds a kernel of the integrator. An error is returned at the end.
    pub fn add(&mut self, kernel: Result<Kernel, Error>) {
        self.flush();
        match kernel {
            Ok(kernel) => self.plan.add(kernel),
            Err(error) => {
                self.error.get_or_insert(error);
            }
        }
    }
}
