//! The verbs of implicit integrators.

use super::Step;
use crate::forces::{Component, Law, Over, Stage};
use crate::integrators::verbs::keep::copy;
use crate::integrators::verbs::solve::{
    EXPLICIT, START_POSITION, START_VELOCITY, STATE, System, begin, iterate, report, rows, update,
};
use crate::kernel::{ACCELERATION, POSITION, VELOCITY};
use crate::visit::Jacobian;

/// A part of a step by backward Euler: v = v₀ + h a(x₀ + h v, v), x = x₀ + h v.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Implicit {
    /// The length h of the part, relative to the step.
    pub part: f64,
    /// The time of its end, relative to the step.
    pub until: f64,
    /// The positions at which laws without a Jacobian are evaluated.
    pub explicit: Explicit,
    /// The method by which the equations are solved.
    pub form: Form,
}

/// The positions at which laws without a Jacobian are evaluated, once per solve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Explicit {
    /// At the start of the part.
    Here,
    /// At an estimate of its end, x₀ + h v₀.
    Ahead,
}

/// The method by which the equations of an implicit step are solved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// One linear solve, of forces linearized about the start of the part (Baraff & Witkin 1998).
    Linear,
    /// Newton's method, until the residual meets the tolerance of the solver.
    Newton,
}

/// The tolerance of a linear solve of Newton's method, relative to that of the method.
const INNER: f64 = 0.25;

/// The forces that enter the matrix of an implicit solve: those whose laws all have a Jacobian. Of laws of links only the first enters. A
/// law that writes columns other than the acceleration does not: it would add to them in each solve.
#[must_use]
pub fn implicit(forces: &[Box<dyn Component>]) -> Vec<bool> {
    let mut tied = false;
    let mut enters = |force: &dyn Component| {
        let laws = force.laws();
        let links = laws.iter().filter(|law| law.over == Over::Links).count();
        let good = |law: &Law| {
            law.into == [ACCELERATION.name]
                && matches!(
                    (law.over, &law.jacobian),
                    (Over::Each, Some(Jacobian::Each(_))) | (Over::Links, Some(Jacobian::Links(_)))
                )
        };
        let all = !laws.is_empty() && laws.iter().all(good) && (links == 0 || links == 1 && !tied);
        tied |= all && links == 1;
        all
    };
    forces.iter().map(|force| enters(force.as_ref())).collect()
}

impl Step<'_> {
    /// A part of the step by backward Euler, from the current positions. It applies no constraints and no boundaries:
    /// [`settle`](Step::settle) does.
    pub fn solve(&mut self, by: Implicit) {
        let which = implicit(self.forces);
        let (count, factor, solver) = (self.problem.capacity, by.part, self.problem.solver);
        self.add(copy(count, "start", POSITION, START_POSITION));
        self.add(copy(count, "start", VELOCITY, START_VELOCITY));
        let explicit = which.iter().any(|enters| !enters);
        let ahead = explicit && by.explicit == Explicit::Ahead;
        if ahead {
            self.at(by.until);
            self.add(update::reach(count, factor));
        }
        // Trees use the last accelerations, before they are cleared.
        let laws = self.laws(|place| !which[place]);
        self.clear();
        self.add_laws(laws);
        if ahead {
            self.add(update::reach(count, 0.0));
        } else {
            self.at(by.until);
        }
        let newton = by.form == Form::Newton;
        if newton && explicit {
            self.add(copy(count, "keep explicit", ACCELERATION, EXPLICIT));
        }
        let laws: Vec<Law> =
            self.forces.iter().zip(&which).filter(|(_, enters)| **enters).flat_map(|(force, _)| force.laws()).collect();
        let links = laws.iter().find(|law| law.over == Over::Links).cloned();
        let each: Vec<_> = laws.into_iter().filter(|law| law.over == Over::Each).collect();
        let tied = links.is_some();
        let problem = self.problem.clone();
        let system = System { problem: &problem, factor, links };
        // In exact arithmetic it ends after as many iterations as there are unknowns; twice that allows for rounding.
        let unknowns = count.saturating_mul(3);
        let limit = if tied { solver.iterations.min(unknowns.saturating_mul(2).saturating_add(8)) } else { 0 };
        let linear = |step: &mut Self, start: bool| {
            step.gather(|place| which[place]);
            step.rows(&system, &each, start);
            if tied || newton {
                step.iterate(&system, limit, if newton { INNER } else { 1.0 });
            }
            step.add(update::kernel(&system, start));
            step.add(update::reach(count, factor));
        };
        linear(self, true);
        if newton {
            self.repeat(solver.solves - 1, STATE, "settled", |step| {
                step.again(explicit);
                linear(step, false);
            });
            // One more evaluation, which decides.
            self.again(explicit);
            self.gather(|place| which[place]);
            self.rows(&system, &[], false);
            self.iterate(&system, 0, INNER);
        }
        if tied || newton {
            self.add(report::kernel(&system, newton));
        }
        self.solved_pairs(factor, by.until);
    }
    /// From the middle of the step to its end, along the straight line from the start of the last solve: x ← x₀ + v dt, v ← 2 v − v₀.
    pub fn extrapolate(&mut self) {
        self.extrapolated_pairs();
        self.add(update::reach(self.problem.capacity, 1.0));
        self.add(update::extrapolate(self.problem.capacity));
    }
    /// Applies constraints and boundaries to velocities and positions, after a part of the step.
    pub fn settle(&mut self, factor: f64) {
        self.limit();
        self.enclose();
        self.problem.reached = 1.0;
        self.each(Stage::AfterAdvance { factor });
    }

    /// Restores the accelerations of explicit laws, to which implicit laws add theirs.
    fn again(&mut self, explicit: bool) {
        if explicit {
            self.add(copy(self.problem.capacity, "restore explicit", EXPLICIT, ACCELERATION));
        } else {
            self.clear();
        }
    }
    fn rows(&mut self, system: &System<'_>, each: &[Law], start: bool) {
        self.add(rows::kernel(system, start));
        for law in each {
            self.add(law.rows(system.problem, system.factor, start));
        }
        self.add(begin::kernel(system, start));
    }
    /// At most `limit` iterations. Two buffers of the state alternate: one iteration, and then pairs of them, so that the
    /// last one ends in the buffer that is read later. If the first half of a pair converges, the second only copies
    /// the state.
    fn iterate(&mut self, system: &System<'_>, limit: u32, part: f64) {
        let half = |step: &mut Self, turned: bool| {
            step.add(iterate::product(system, turned));
            step.add(iterate::advance(system, turned, limit, part));
        };
        half(self, true);
        self.repeat(limit.div_ceil(2), STATE, "code", |step| {
            half(step, false);
            half(step, true);
        });
    }
    /// A loop that runs until a member of a state is set.
    pub(super) fn repeat(
        &mut self,
        most: u32,
        state: &'static str,
        until: &'static str,
        write: impl FnOnce(&mut Self),
    ) {
        if most == 0 {
            return;
        }
        self.flush();
        let before = std::mem::take(&mut self.plan);
        write(self);
        let body = std::mem::replace(&mut self.plan, before);
        if let Err(error) = self.plan.repeat(most, state, 0, until, body) {
            self.error.get_or_insert(error);
        }
    }
}
