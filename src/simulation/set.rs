//! Settings that change between two steps. Plans are rewritten with them, and their programs use the existing pipelines:
//! only numbers differ, and nothing is compiled.

use std::collections::BTreeSet;

use super::fields::Fields;
use super::setup::limited;
use super::{Plans, Setup, Simulation, alarm, inactive, restart};
use crate::component::Setting;
use crate::error::Error;
use crate::forces::{Change, Component, Law, numbered};
use crate::kernel::{Backend, Column, Plan, Problem};
use crate::motion::{self, Motion};
use crate::settings::nearest;
use crate::visit::{self, LINK};

/// The remedy where a setting requires another plan.
const ANEW: &str = "make another simulation, of a setup with the state of `snapshot()`";

impl<B: Backend> Simulation<B> {
    /// Changes a setting of a force, an obstacle or a solid, a parameter of a user's law, or one of its tables, from the next step on.
    /// `force` is its name as `motes explain` has it: `"gravity"`, and `"solid 2"` for the second of its kind. Settings are checked as
    /// they are at the start, nothing is compiled, and states that are saved later continue under [`Simulation::setup`] as it is then.
    ///
    /// Where it changes accelerations at the present state, the next step begins with these. Steps that a caller has encoded before
    /// keep what they were encoded with.
    ///
    /// Some settings are compiled into kernels, or decide the size of buffers, and are refused: the medium of a fluid (`density`,
    /// `spacing`, `support`, `gamma`, `sound_speed`), the `range` of a search, `theta` of a tree, the `accuracy` of Ewald sums, the `strain` of a strain limit, the
    /// `truncation` of a pair potential, and those that add a term where they were 0, such as a fluid's `viscosity`.
    ///
    /// # Errors
    /// [`Error::Setting`] and [`Error::Scene`] when there is no such force or setting, with the nearest name; when the value is of
    /// another kind or out of its range, with the number; when the setting changes the kernels, and not only their numbers. Nothing has
    /// changed then.
    pub fn set(&mut self, force: &str, setting: &str, to: impl Into<Change>) -> Result<(), Error> {
        self.set_all(force, &[(setting, to.into())])
    }
    /// The same with several settings of a force, which change together.
    ///
    /// # Errors
    /// As for [`Simulation::set`]. Nothing has changed then.
    pub fn set_all(&mut self, force: &str, settings: &[(&str, Change)]) -> Result<(), Error> {
        let place = self.place(force)?;
        let mut forces = self.setup.forces.clone();
        for (setting, to) in settings {
            forces[place] = forces[place].changed(setting, to)?;
        }
        let names: Vec<_> = settings.iter().map(|(setting, _)| format!("`{setting}`")).collect();
        let setup = Setup { forces, ..self.setup.clone() };
        self.exchange(setup, (*self.problem).clone(), &format!("{} of `{force}`", names.join(", ")))
    }
    /// The names of the forces, and their settings as they are now.
    #[doc(hidden)]
    #[must_use]
    pub fn settings(&self) -> Vec<(String, Vec<Setting<'_>>)> {
        names(&self.setup.forces).into_iter().zip(self.setup.forces.iter().map(|force| force.settings())).collect()
    }
    /// Replaces the motion of the same name, from the next step on: particles and obstacles with it move to their new poses. Keys are at
    /// times of the run, as at its start.
    ///
    /// # Errors
    /// [`Error::Scene`] when there is no motion of that name, or the new one is invalid. Nothing has changed then.
    pub fn set_motion(&mut self, motion: Motion) -> Result<(), Error> {
        let mut motions = self.problem.motions.as_ref().clone();
        let names: Vec<&str> = motions.iter().map(|motion| motion.name.as_str()).collect();
        let Some(place) = names.iter().position(|name| *name == motion.name) else {
            return Err(Error::Scene(format!(
                "no motion is called \"{}\"{}; there are {}",
                motion.name,
                meant(&motion.name, &names),
                if names.is_empty() { "none".to_owned() } else { names.join(", ") }
            )));
        };
        let what = format!("the motion \"{}\"", motion.name);
        motions[place] = motion;
        motion::check(&[], &motions, 0, self.setup.bounds.dimensions, self.setup.dt)?;
        let problem = (*self.problem).clone().moved(&motions, self.setup.dt);
        self.exchange(self.setup.clone(), problem, &what)?;
        self.ties.lead(motions);
        Ok(())
    }
    /// The index of a force, by its name.
    fn place(&self, name: &str) -> Result<usize, Error> {
        let names = names(&self.setup.forces);
        names.iter().position(|known| known == name).ok_or_else(|| {
            let known: Vec<&str> = names.iter().map(String::as_str).filter(|name| !name.is_empty()).collect();
            let there = if known.is_empty() { "none".to_owned() } else { known.join(", ") };
            Error::Scene(format!("no force is called `{name}`{}; known are {there}", meant(name, &known)))
        })
    }
    /// Continues with other numbers in the same kernels.
    fn exchange(&mut self, setup: Setup, problem: Problem, what: &str) -> Result<(), Error> {
        setup.fluids()?;
        if setup.integrator.adaptive_step().is_some() {
            setup.bear()?;
        }
        if problem.has_inactive {
            inactive::evaluate_active(&setup.forces)?;
        }
        limited(&setup.forces, &self.largest)?;
        let refuse = |why: &str| Err(Error::Scene(format!("{what} {why}: {ANEW}")));
        let shape = |setup: &Setup| {
            let laws: Vec<Law> = setup.forces.iter().flat_map(|force| force.laws()).collect();
            visit::shared_list(&laws, &problem)
        };
        let (old, new) = (shape(&self.setup)?, shape(&setup)?);
        if old.map(|list| list.exclude) != new.map(|list| list.exclude) {
            return refuse("changes which bonded pairs the list of neighbours leaves out");
        }
        if old != new {
            return refuse("changes how far the list of neighbours reaches, and with it the room for them");
        }
        if setup.breaks() != self.setup.breaks() {
            return refuse("changes whether bonds break");
        }
        let columns = |setup: &Setup| -> Vec<Column> {
            // The value that new particles begin with is a number.
            let all = setup.forces.iter().flat_map(|force| force.columns());
            all.map(|column| Column { initial: None, ..column }).collect()
        };
        if columns(&setup) != columns(&self.setup) {
            return refuse("changes which quantities particles have");
        }
        let plans = setup.plans_of(&problem)?;
        if !kernels(&plans).is_subset(&kernels(&self.plans)) {
            return refuse("changes what kernels do, and not only their numbers");
        }
        let count = self.rows.capacity();
        let fields = Fields::of(&plans, count);
        let tables = changed_tables(&self.plans, &plans);
        if !self.fields.differ(&fields, &tables).is_empty() || tables.contains(LINK) {
            return refuse("changes the size or the contents of buffers that steps write");
        }
        self.unrepeatable();
        // Steps that have been encoded or submitted keep their tables.
        tables.iter().for_each(|name| self.backend.forget(name));
        self.start = self.backend.compile(&plans.start)?;
        self.step = self.backend.compile_often(&plans.step)?;
        self.measure = (self.backend.compile(&plans.measure.0)?, self.backend.compile(&plans.measure.1)?);
        self.begun &= restart::print(&plans.start, &problem) == restart::print(&self.plans.start, &problem);
        self.print = restart::print(&plans.step, &problem);
        self.marks = alarm::marks(&plans);
        self.plan = plans.step.to_string();
        (self.setup, self.problem, self.plans, self.fields) = (setup, Box::new(problem), Box::new(plans), fields);
        Ok(())
    }
}

/// The names of forces, each with its number where there are several.
fn names(forces: &[Box<dyn Component>]) -> Vec<String> {
    let earlier = |place: usize, name: &str| forces[..place].iter().filter(|force| force.name() == name).count();
    forces.iter().enumerate().map(|(place, force)| numbered(force.name(), earlier(place, force.name()))).collect()
}

fn meant(name: &str, known: &[&str]) -> String {
    nearest(name, known.iter().copied()).map_or_else(String::new, |near| format!(" (did you mean `{near}`?)"))
}

/// The inputs of a kernel's compilation.
type Compiled<'a> = (&'a str, Vec<(&'static str, u64)>);

/// The compiled kernels of all plans.
fn kernels(plans: &Plans) -> BTreeSet<Compiled<'_>> {
    let passes = plans.all().flat_map(|plan| &plan.kernels).flat_map(|kernel| &kernel.passes);
    let constants = |list: &[(&'static str, f64)]| list.iter().map(|(name, value)| (*name, value.to_bits())).collect();
    passes.map(|pass| (pass.shader.text(), constants(&pass.constants))).collect()
}

/// The names of the tables whose contents differ.
fn changed_tables(old: &Plans, new: &Plans) -> BTreeSet<String> {
    let of = |plans: &Plans, name: &str| plans.all().find_map(|plan: &Plan| plan.table(name).cloned());
    let tables = new.all().flat_map(|plan| &plan.kernels).flat_map(|kernel| &kernel.tables);
    let names: BTreeSet<String> = tables.map(|(name, _)| name.to_string()).collect();
    names.into_iter().filter(|name| of(old, name) != of(new, name)).collect()
}
