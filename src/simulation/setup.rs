//! The setup of a simulation, its validation, and the plans made from it.

use std::collections::BTreeMap;

use glam::DVec3;

use super::{columns, inactive, initial_projection, lists, pair_history, refuses_own_steps, tables, unwritten};
use crate::boundary;
use crate::component::{self, Properties};
use crate::crowds;
use crate::error::Error;
use crate::forces::{Component, Over, Problem, Stage};
use crate::integrators::{self, Integrator, Leapfrog, Step};
use crate::kernel::{Bounds, Column, Columns, ListShape, Machine, Plan, Solver, claims};
use crate::life;
use crate::motion::{self, Hold};
use crate::sph::{Start, Still};
use crate::state::{KEPT_ROWS, NONE, State, distinct};

/// The input of a simulation.
#[derive(Clone)]
pub struct Setup {
    /// The initial state.
    pub state: State,
    /// The forces, constraints and updaters, in the order of evaluation.
    pub forces: Vec<Box<dyn Component>>,
    /// The integrator.
    pub integrator: Box<dyn Integrator>,
    /// The step size \[time\].
    pub dt: f64,
    /// The box and its boundaries.
    pub bounds: Bounds,
    /// The tolerances of implicit integrators; others ignore them.
    pub solver: Solver,
}

/// The plans of a simulation: what runs once, what runs in every step, and what surrounds a measurement.
pub struct Plans {
    /// Before the first step.
    pub start: Plan,
    /// A step.
    pub step: Plan,
    /// Before and after the state is read.
    pub measure: (Plan, Plan),
    /// Before data is copied to other buffers: saves what the next step uses.
    pub keep: Plan,
    /// Where a run continues: sets the time.
    pub time: Plan,
    /// The list of neighbours that they share, if any.
    pub list: Option<ListShape>,
}

impl Plans {
    /// All plans but `keep` and `time`, which bind nothing that these do not.
    pub fn all(&self) -> impl Iterator<Item = &Plan> + Clone {
        [&self.start, &self.step, &self.measure.0, &self.measure.1].into_iter()
    }
    /// The plan that runs once where a run continues; it also restores the restart data of the last step, if there is any.
    #[must_use]
    pub fn wake(&self, keeps: bool) -> Plan {
        let mut plan = self.time.clone();
        if keeps {
            plan.append(self.measure.1.clone());
        }
        plan
    }
}

impl Setup {
    /// A state in open space under some forces, in steps of `dt` by leapfrog; change the fields for anything else.
    #[must_use]
    pub fn new(state: State, forces: Vec<Box<dyn Component>>, dt: f64) -> Self {
        let (bounds, solver) = (Bounds::default(), Solver::default());
        Self { state, forces, integrator: Box::new(Leapfrog), dt, bounds, solver }
    }
    /// Writes the plans for a machine.
    ///
    /// # Errors
    /// When the setup is invalid, or a shader does not compile.
    pub fn plans(&self, machine: Machine) -> Result<Plans, Error> {
        if let Some(stretched) = self.stretched()? {
            return stretched.plans(machine);
        }
        if let Some(padded) = self.padded() {
            return padded.plans(machine);
        }
        self.plans_of(&self.problem(machine)?)
    }
    /// Like [`Setup::plans`], for a problem of this setup.
    pub(super) fn plans_of(&self, problem: &Problem) -> Result<Plans, Error> {
        self.weigh(problem)?;
        let list = problem.list;
        let mut start = Step::new(&self.forces, problem.clone());
        start.prove();
        start.enclose();
        start.lead();
        start.populate();
        start.begin();
        self.integrator.start(&mut start);
        let mut step = Step::new(&self.forces, problem.clone());
        step.adaptive_step();
        step.lead();
        step.open();
        self.integrator.step(&mut step);
        let columns = problem.columns.clone();
        let time = Step::time(problem)?;
        let measure = Step::measurement(&self.forces, problem.clone())?;
        let keep = Step::keeping(&self.forces, problem.clone())?;
        let plans = Plans { start: start.begun()?, step: step.done()?, measure, keep, time, list };
        integrators::check_precision(self.integrator.as_ref(), [&plans.start, &plans.step])?;
        claims(&plans.all(), &columns)?;
        pair_history::once(&self.forces, &plans.step)?;
        tables::agree(plans.all())?;
        unwritten::check(&plans, &columns)?;
        unwritten::in_order(&plans.measure.0, &columns)?;
        Ok(plans)
    }
    /// The same setup with free rows, where its state has a capacity and no free rows yet.
    pub(super) fn padded(&self) -> Option<Self> {
        self.state.padded().map(|state| self.with_state(state))
    }
    /// The same setup with another state.
    #[must_use]
    pub fn with_state(&self, state: State) -> Self {
        let (forces, integrator) = (self.forces.clone(), self.integrator.clone());
        Self { state, forces, integrator, dt: self.dt, bounds: self.bounds, solver: self.solver }
    }
    /// The number of rows that were free when a plan was first written for this run.
    pub(super) fn free(&self) -> u32 {
        let rows = u32::try_from(self.state.len()).unwrap_or(u32::MAX);
        let kept =
            self.state.kept.get(KEPT_ROWS).and_then(|list| list.first()).filter(|_| self.state.capacity.is_some());
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "saturates")]
        let kept = kept.map(|used| rows.saturating_sub(*used as u32));
        kept.unwrap_or_else(|| self.state.free_rows())
    }
    /// Refuses components that require a fixed time step, where steps are adaptive.
    pub(super) fn bear(&self) -> Result<(), Error> {
        if let Some(why) = self.integrator.fixed_step() {
            return Err(Error::Scene(format!("steps cannot be adaptive: {why}; choose leapfrog, or a fixed dt")));
        }
        match self.forces.iter().find_map(|force| force.properties().fixed_step) {
            Some(why) => return Err(Error::Scene(format!("steps cannot be adaptive: {why}; choose a fixed dt"))),
            None if !self.integrator.estimates_error() => {}
            None => {
                if let Some(why) = refuses_own_steps(&self.state, &self.forces, &self.bounds) {
                    return Err(Error::Scene(why));
                }
            }
        }
        Ok(())
    }
    /// Refuses a second thermostat, and a second search for collisions.
    fn has_one_of_a_kind(&self) -> Result<(), Error> {
        let refuse = |chosen: fn(&Properties) -> bool, why: &str| {
            let all: Vec<&str> = self.forces.iter().filter(|f| chosen(&f.properties())).map(|f| f.name()).collect();
            let [first, second, ..] = all[..] else { return Ok(()) };
            let text = if first == second {
                format!("{first} is there twice")
            } else {
                format!("{first} and {second} are there")
            };
            Err(Error::Scene(format!("{text}, and {why}: remove one of them")))
        };
        refuse(|one| one.thermostat, "each would regulate the same particles")?;
        refuse(|one| one.collides.is_some(), "a body collides with one other in a step")
    }
    /// Refuses an integrator that begins steps with forces of other positions, where a component needs those of the present ones.
    fn has_forces_in_time(&self) -> Result<(), Error> {
        match self.forces.iter().find(|force| force.properties().needs_forces) {
            Some(force) if !self.integrator.ends_with_forces() => Err(Error::Scene(format!(
                "{} needs the forces of the positions at which a step begins, and {} does not have them: choose leapfrog or beeman",
                force.name(),
                self.integrator.name()
            ))),
            _ => Ok(()),
        }
    }
    /// Refuses a tree whose nodes do not fit single precision.
    fn weigh(&self, problem: &Problem) -> Result<(), Error> {
        let walks = self.forces.iter().flat_map(|force| force.laws()).any(|law| law.tree(problem).is_some());
        let mass: f64 = self.state.mass().iter().sum();
        let side = (problem.extent.1 - problem.extent.0).max_element();
        let moment = mass * side * side;
        if walks && moment > f64::from(f32::MAX) {
            return Err(Error::Scene(format!(
                "a tree keeps the second moments of its groups, here up to {moment:.0e}, and single precision ends at 3.4e38: \
                 choose larger units of mass or length, or over = \"pairs\""
            )));
        }
        Ok(())
    }
    /// The problem for which plans are written.
    ///
    /// # Errors
    /// When the setup is invalid.
    pub fn problem(&self, machine: Machine) -> Result<Problem, Error> {
        if let Some(stretched) = self.stretched()? {
            return stretched.problem(machine);
        }
        if let Some(padded) = self.padded() {
            return padded.problem(machine);
        }
        let rows = self.state.len().saturating_sub(self.state.free_rows() as usize);
        let problem = Problem::new(self.check()?, machine).at(self.state.position(), self.bounds);
        let estimates_error = self.integrator.estimates_error();
        let problem = Problem { extent: self.extent(), estimates_error, ..problem }
            .with_free(self.free())
            .of_species(&self.state.species()[..rows])
            .tied(&self.state.all_links(), &self.state.held)
            .moved(&self.state.motions, self.dt)
            .with_life(&self.state.births, &self.state.drains, self.has_inactive())
            .on_floor(self.state.floor_plan.clone())
            .with_ids(self.state.has_ids() || self.state.capacity.is_some())
            .breaking(self.breaks())
            .stretched(self.elastic())
            .solved(self.solver)
            .adapted(self.integrator.adaptive_step())
            .in_blocks(self.block_steps())
            .precise(self.integrator.precision())
            .of_columns(self.columns()?);
        lists::counted(self, problem)
    }
    /// The columns that all simulations have, those that components declare, and those that the state brings along.
    ///
    /// # Errors
    /// [`Error::Scene`] when two declarations of one name differ, or a declaration is invalid.
    pub fn columns(&self) -> Result<Columns, Error> {
        let forces = component::declared(&self.forces);
        let integrator = self.integrator.columns();
        let of_plan = |plan| self.forces.iter().flat_map(move |force| force.plan_columns(plan));
        let of_plan = self.state.floor_plan.iter().flat_map(|plan| of_plan(plan.as_ref()));
        let mut all: Vec<Column> =
            forces.chain(of_plan).chain(integrator).chain(columns::of_held(&self.state.held)).collect();
        let known = Columns::with(all.clone())?;
        for column in self.state.declared() {
            match known.get(&column.name) {
                Some(known) if (known.kind, known.shape) == (column.kind, column.shape) => {}
                Some(known) => {
                    return Err(Error::Scene(format!(
                        "the column `{}` of the state is {} ({:?}), and a force has it as {} ({:?}): give it another name",
                        column.name,
                        column.kind.name(),
                        column.shape,
                        known.kind.name(),
                        known.shape
                    )));
                }
                None => all.push(column.clone()),
            }
        }
        Columns::with(all)
    }
    /// Whether forces have kernels that run once, before the first step.
    pub(super) fn begins(&self, problem: &Problem) -> Result<bool, Error> {
        let mut plan = Plan::default();
        self.forces.iter().try_for_each(|force| force.stage(Stage::Start, &mut plan, problem))?;
        Ok(!plan.is_empty())
    }
    /// The initial state of its fluid, if there is one: the density before the first step, by direct summation, which takes as
    /// long as some steps on the host.
    ///
    /// # Errors
    /// When the setup is invalid, a fluid particle has mass 0, or the initial pressure would make the fluid explode:
    /// [`Error::Scene`] names the particles and the cause.
    pub fn start(&self) -> Result<Option<Start>, Error> {
        let problem = self.problem(Machine::HOST)?;
        let mut media = self.forces.iter().map(|force| Ok(force.resolved(&problem)?.fluid));
        let Some(fluid) = media.find_map(Result::<_, Error>::transpose).transpose()? else { return Ok(None) };
        // Inactive particles do not count; a scene gives them the last ids.
        let living: Vec<usize> = (0..self.state.len()).filter(|id| self.state.is_active(*id)).collect();
        let of = |list: &[DVec3]| -> Vec<DVec3> { living.iter().map(|id| list[*id]).collect() };
        let initial_projection::Projected { places, moved } = initial_projection::projected(self, &problem)?;
        let (position, velocity) = (of(&places), of(self.state.velocity()));
        let mass: Vec<f64> = living.iter().map(|id| self.state.mass()[*id]).collect();
        let walls: Vec<bool> = living.iter().map(|id| problem.is_held(*id)).collect();
        if problem.has_inactive && walls.iter().all(|wall| *wall) {
            return Ok(None);
        }
        let bounds = self.state.boxed(&self.bounds);
        let still = Still { position: &position, mass: &mass, walls: &walls, bounds: &bounds };
        let mut start = Start::of(&fluid, &still)?;
        let speeds = velocity.iter().zip(&walls).filter(|(_, wall)| !**wall).map(|(v, _)| v.length());
        start.speed = speeds.fold(0.0, f64::max);
        let solids = |error: Error| match (error, moved.first()) {
            (Error::Scene(why), Some((id, depth))) => Error::Scene(format!(
                "{why}; {} particles start inside of obstacles or closer than their thickness, the first is particle {id}, by {depth:.3e}, \
                 and densities are computed after their initial projection: move them out of the obstacles",
                moved.len()
            )),
            (error, _) => error,
        };
        start.check().map_err(solids)?;
        Ok(Some(start))
    }
    /// The particles that the initial projection moves out of obstacles, and by how much \[length\].
    ///
    /// # Errors
    /// When the setup is invalid.
    pub fn put_out(&self) -> Result<Vec<(usize, f64)>, Error> {
        Ok(initial_projection::projected(self, &self.problem(Machine::HOST)?)?.moved)
    }
    /// Refuses invalid settings, and two fluids: each would contain all particles.
    pub(super) fn fluids(&self) -> Result<(), Error> {
        self.forces.iter().try_for_each(|force| force.check(&self.bounds))?;
        let count = self.forces.iter().filter(|force| force.properties().makes_fluid).count();
        if count > 1 {
            return Err(Error::Scene(format!(
                "there are {count} fluids, and each would apply its pressure to all particles: keep one of them"
            )));
        }
        Ok(())
    }
    /// Refuses fluid particles without mass.
    pub(super) fn weighs(&self, problem: &Problem) -> Result<(), Error> {
        for force in self.forces.iter().filter(|force| force.properties().makes_fluid) {
            if let Some(fluid) = force.resolved(problem)?.fluid {
                let free = (0..self.state.len()).filter(|id| self.state.is_active(*id) && !problem.is_held(*id));
                fluid.medium.weighs(free.map(|id| (id, self.state.mass()[id])))?;
            }
        }
        Ok(())
    }
    /// Refuses a state without a column that has no initial value, and numbers that are not finite.
    fn complete(&self) -> Result<(), Error> {
        for column in self.columns()?.state() {
            let name = &column.name;
            let Some(values) = self.state.get(name) else {
                if column.initial.is_some() {
                    continue;
                }
                return Err(Error::Scene(format!(
                    "the column `{name}` has no initial value, and the state does not give it: give every particle one"
                )));
            };
            if let Some(place) = values.unfit() {
                return Err(Error::Scene(format!(
                    "particle {} has a `{name}` that is NaN, infinite or beyond single precision",
                    place / column.shape.len(1).max(1)
                )));
            }
        }
        Ok(())
    }
    /// The largest values of the columns that forces limit, with their particles; not smaller than the known ones.
    pub(super) fn largest(&self, known: &BTreeMap<&'static str, Largest>) -> BTreeMap<&'static str, Largest> {
        let mut all = known.clone();
        for limit in self.forces.iter().flat_map(|force| force.properties().largest) {
            let values = self.state.scalar(limit.column).unwrap_or_default().iter().zip(0..);
            let largest =
                values.max_by(|a, b| a.0.total_cmp(b.0)).map(|(value, particle)| Largest { value: *value, particle });
            let Some(largest) = largest else { continue };
            let entry = all.entry(limit.column).or_insert(largest);
            if largest.value > entry.value {
                *entry = largest;
            }
        }
        all
    }
    /// Refuses particles with numbers that are not finite, and incomplete columns.
    pub(super) fn particles(&self) -> Result<(), Error> {
        let state = &self.state;
        let (position, velocity, mass, size) = (state.position(), state.velocity(), state.mass(), state.size());
        let count = position.len();
        let fits = |x: f64| x.abs() <= f64::from(f32::MAX);
        let bad = (0..count).find_map(|i| {
            let vectors = [("position", position[i]), ("velocity", velocity[i])].into_iter();
            let mut vectors = vectors.filter(|(_, v)| !v.to_array().into_iter().all(fits));
            let mut numbers =
                [("mass", mass[i]), ("size", size[i])].into_iter().filter(|(_, x)| !(fits(*x) && *x >= 0.0));
            let vector = vectors.next().map(|(what, v)| format!("particle {i} has the {what} {:?}", v.to_array()));
            vector.or_else(|| numbers.next().map(|(what, x)| format!("particle {i} has the {what} {x:?}")))
        });
        if let Some(bad) = bad {
            return Err(Error::Scene(format!(
                "{bad}: numbers must be finite and within single precision, and a mass or a size must not be negative"
            )));
        }
        self.complete()?;
        for column in self.forces.iter().flat_map(|force| force.properties().largest).map(|limit| limit.column) {
            let values = state.scalar(column).unwrap_or_default();
            if let Some((value, place)) = values.iter().zip(0..).find(|(value, _)| **value < 0.0) {
                let place: usize = place;
                return Err(Error::Scene(format!(
                    "particle {place} has the {column} {value}: it is a length; give 0 or above"
                )));
            }
        }
        let largest = self.largest(&BTreeMap::new());
        limited(&self.forces, &largest)
    }
    /// Whether every particle is accelerated independently of all others.
    pub(super) fn accelerates_each_alone(&self) -> bool {
        let alone = |force: &dyn Component| {
            let laws = force.laws();
            !laws.is_empty() && laws.iter().all(|law| matches!(law.over, Over::Each))
        };
        self.forces.iter().all(|force| alone(force.as_ref()))
    }
    /// Whether some particles are inactive at some time.
    #[must_use]
    pub fn has_inactive(&self) -> bool {
        self.state.has_inactive() || self.removes()
    }
    /// Whether a component removes particles.
    pub(super) fn removes(&self) -> bool {
        self.forces.iter().any(|force| force.properties().removes)
    }
    /// Whether links may break during the run.
    #[must_use]
    pub fn breaks(&self) -> bool {
        self.forces.iter().any(|force| force.properties().breaks_bonds)
    }
    /// Refuses particles off the floor of a plan: at the start all of them, and in a run that goes on those that walls keep.
    pub(crate) fn on_the_floor(&self) -> Result<(), Error> {
        let Some(plan) = &self.state.floor_plan else { return Ok(()) };
        let kept = || self.forces.iter().any(|force| force.properties().keeps_in);
        if self.state.step == 0 || kept() { crowds::on_the_floor(plan, &self.state) } else { Ok(()) }
    }
    /// The number of particles, if the setup is valid.
    ///
    /// # Errors
    /// [`Error::Scene`] when there are none or too many, when dt is not a positive number, when a particle has a number
    /// that is not finite, or a negative mass, when the box is invalid, or when particles are outside it.
    pub fn check(&self) -> Result<u32, Error> {
        if let Some(stretched) = self.stretched()? {
            return stretched.check();
        }
        let state = &self.state;
        let State { links, held, motions, births, drains, .. } = state;
        let (position, velocity, mass) = (state.position(), state.velocity(), state.mass());
        let (count, life) = (position.len(), &state.life());
        let single = f64::from(f32::MIN_POSITIVE)..=f64::from(f32::MAX);
        if !single.contains(&self.dt) {
            let text = format!("dt is {}: it must be from 1.2e-38 to 3.4e38, the range of single precision", self.dt);
            return Err(Error::Scene(text));
        }
        self.particles()?;
        self.done()?;
        self.fluids()?;
        if state.has_ids() {
            let ids = state.ids();
            let given = ids.iter().copied().zip(0..).filter(|(id, place)| *id != NONE || state.is_active(*place));
            distinct(&given.map(|(id, _)| id).collect::<Vec<_>>())?;
        }
        links.check(mass)?;
        self.solver.check()?;
        if let Some(adaptive_step) = self.integrator.adaptive_step() {
            adaptive_step.check(self.dt)?;
            self.bear()?;
        }
        self.serves_blocks()?;
        boundary::check(&self.bounds)?;
        self.on_the_floor()?;
        motion::check(held, motions, count, self.bounds.dimensions, self.dt)?;
        life::check((life, births, drains), held, count, self.bounds.dimensions)?;
        self.has_one_of_a_kind()?;
        self.has_forces_in_time()?;
        self.serves_barostat()?;
        inactive::serves(&self.state, &self.forces, self.integrator.as_ref())?;
        if !links.rods.is_empty() && !self.forces.iter().any(|force| force.properties().keeps_rods) {
            let text = format!(
                "nothing keeps the lengths of the rods (of which there are {}): add a [[force]] of kind = \"rod\"",
                links.rods.len()
            );
            return Err(Error::Scene(text));
        }
        let still = held.iter().filter(|held| held.by == Hold::Fixed).map(|held| held.id).collect();
        let held: Vec<u32> = held.iter().map(|held| held.id).collect();
        links.check_rods([position, velocity], &held, &still, |r| self.bounds.shortest(r))?;
        boundary::holds(&self.bounds, position, velocity)?;
        u32::try_from(state.rows())
            .ok()
            .filter(|n| *n > 0)
            .ok_or_else(|| Error::Scene(format!("there are {count} particles: a simulation takes 1 to {}", u32::MAX)))
    }
}

/// The largest value of a column, and its particle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Largest {
    value: f64,
    particle: usize,
}

/// Refuses values above the limit of a force.
pub(super) fn limited(forces: &[Box<dyn Component>], largest: &BTreeMap<&'static str, Largest>) -> Result<(), Error> {
    for limit in forces.iter().flat_map(|force| force.properties().largest) {
        let Some(Largest { value, particle }) = largest.get(limit.column) else { continue };
        // Compared in single precision, as on the device.
        #[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is what the device does")]
        if (*value as f32) > limit.value as f32 {
            return Err(Error::Scene(format!(
                "particle {particle} has the {} {value}, and the largest that a force allows is {}: {}",
                limit.column, limit.value, limit.why
            )));
        }
    }
    Ok(())
}
