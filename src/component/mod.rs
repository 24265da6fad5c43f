//! A component of a simulation: its declarations and its kernels in a step. Everything else is derived from them.

pub(crate) mod barostat;
pub(crate) mod bath;
mod each;
pub(crate) mod keys;
pub(crate) mod kind;
mod misnamed;
pub(crate) mod pressure;
mod register;
mod registered;
pub(crate) mod thermostat;

pub(crate) use each::each;
pub(crate) use misnamed::misnamed;
pub(crate) use register::components;
pub(crate) use registered::registered;

use std::sync::Arc;

use glam::{DVec3, Vec4};

use crate::cosmology::Expansion;
use crate::crowds::Press;
use crate::error::Error;
use crate::floor_plan::FloorPlan;
use crate::grains::{ContactForce, Material};
use crate::kernel::{Bounds, Column, Plan, Problem, Way};
use crate::neighbors::Grid;
use crate::settings::{Key, Settings, Value};
use crate::solids::Standing;
use crate::sph::{Continuum, Rates};
use crate::state::State;
use crate::visit::Law;
pub use crate::visit::numbered;

/// A component: an interaction, a constraint or an updater. A simulation keeps a copy, from which it rewrites its plan when it
/// allocates more rows.
pub trait Component: Copied + Send + Sync {
    /// The columns that it reads or writes in addition to those of all simulations.
    fn columns(&self) -> Vec<Column> {
        Vec::new()
    }
    /// Columns of its own, which it shares with no other component, where `earlier` of its kind are before it: their names have its number.
    fn own_columns(&self, _earlier: usize) -> Vec<Column> {
        Vec::new()
    }
    /// Columns of its own whose length is by the cells of a floor plan.
    fn plan_columns(&self, _plan: &FloorPlan) -> Vec<Column> {
        Vec::new()
    }
    /// Its laws, in the order in which they are evaluated; a later one may read what an earlier one wrote. Where a component adds its kernels
    /// itself ([`Component::stage`]), others may stand between them, and some be of another stage.
    fn laws(&self) -> Vec<Law> {
        Vec::new()
    }
    /// The forces of its contacts between grains, or of grains with its wall, in a state; `earlier` is that of [`Component::own_columns`].
    ///
    /// # Errors
    /// [`Error::Setting`] where the state lacks its motion.
    fn contacts(&self, _state: &State, _bounds: &Bounds, _earlier: usize) -> Result<Vec<ContactForce>, Error> {
        Ok(Vec::new())
    }
    /// What pairs beyond its cut-off radius lack, by pairs of species; empty where nothing is known to lack.
    fn tails(&self) -> Vec<Tail> {
        Vec::new()
    }
    /// The name used by [`Simulation::set`](crate::Simulation::set); a component with an empty name cannot be set.
    #[expect(clippy::unnecessary_literal_bound, reason = "a user's law has a name of its own")]
    fn name(&self) -> &str {
        ""
    }
    /// Its settings as they are now, in the order of its keys.
    fn settings(&self) -> Vec<Setting<'_>> {
        Vec::new()
    }
    /// The same with one of its settings, or a table of its law, changed.
    ///
    /// # Errors
    /// [`Error::Setting`] or [`Error::Scene`] when it has none of that name, or the value does not fit it.
    fn changed(&self, name: &str, _to: &Change) -> Result<Box<dyn Component>, Error> {
        Err(Error::Scene(format!("the component has no setting `{name}`: it has none")))
    }
    /// Its properties, which depend only on its settings.
    fn properties(&self) -> Properties {
        Properties::default()
    }
    /// Refuses settings that are invalid together, or in such a box.
    ///
    /// # Errors
    /// [`Error::Setting`] with the key, or [`Error::Scene`].
    fn check(&self, _bounds: &Bounds) -> Result<(), Error> {
        Ok(())
    }
    /// Its properties in a problem.
    ///
    /// # Errors
    /// [`Error::Scene`] when it is invalid there.
    fn resolved(&self, problem: &Problem) -> Result<Resolved, Error> {
        let cell_lists = self.laws().into_iter().filter_map(|law| law.grid(problem).transpose());
        Ok(Resolved { cell_lists: cell_lists.collect::<Result<_, _>>()?, ..Resolved::default() })
    }
    /// Adds its kernels at a stage of a step; by default, those of its laws where accelerations are evaluated.
    ///
    /// # Errors
    /// When a law does not compile or lacks a parameter, or the component is invalid there.
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        match stage {
            Stage::Evaluate { earlier } => evaluate(self.laws(), earlier, plan, problem),
            Stage::Carry { earlier } => carry(self.laws(), earlier, plan, problem),
            _ => Ok(()),
        }
    }
}

/// A setting of a component: its name, the values that it accepts, and the present one.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting<'a> {
    /// The table of the force in which a scene gives it, such as `params`; none where it stands in the force itself.
    pub table: Option<&'static str>,
    /// The name in scenes, and of [`Simulation::set`](crate::Simulation::set).
    pub name: &'a str,
    /// The values that it accepts.
    pub kind: crate::settings::Kind,
    /// Its value where a scene leaves it out; none where it must be given.
    pub default: Option<&'a Value>,
    /// One line: what it means, and its unit.
    pub about: &'a str,
    /// Whether particles of a scene have it from the force.
    pub shared: bool,
    /// The present value.
    pub value: &'a Value,
}

/// A new value of a setting or of a table, for [`Simulation::set`](crate::Simulation::set).
#[derive(Debug, Clone, PartialEq)]
pub enum Change {
    /// A setting, or a parameter of a user's law.
    Value(Value),
    /// The words of a table of a user's law, as many as it had.
    Table(Vec<u32>),
}

impl<T: Into<Value>> From<T> for Change {
    fn from(value: T) -> Self {
        Self::Value(value.into())
    }
}
impl From<&[f32]> for Change {
    fn from(elements: &[f32]) -> Self {
        Self::Table(bytemuck::cast_slice(elements).to_vec())
    }
}
impl From<&[u32]> for Change {
    fn from(elements: &[u32]) -> Self {
        Self::Table(elements.to_vec())
    }
}
impl From<&[Vec4]> for Change {
    fn from(elements: &[Vec4]) -> Self {
        Self::Table(bytemuck::cast_slice(elements).to_vec())
    }
}

/// Copying of a boxed component; implemented for everything that is `Clone`.
pub trait Copied {
    /// The copy.
    fn copied(&self) -> Box<dyn Component>;
}

impl<T: Component + Clone + 'static> Copied for T {
    fn copied(&self) -> Box<dyn Component> {
        Box::new(self.clone())
    }
}

impl Clone for Box<dyn Component> {
    fn clone(&self) -> Self {
        (**self).copied()
    }
}

/// The stage of a step at which kernels run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stage {
    /// Once, before the first step, when fixed particles are at their positions.
    Start,
    /// Where accelerations are evaluated.
    Evaluate {
        /// The number of components of the same kind before it in the scene.
        earlier: usize,
    },
    /// Where the rates are computed of columns that are advanced with positions: in the middle of each drift, and in each stage of a
    /// Runge–Kutta step. Cell lists are those of the current positions.
    Carry {
        /// As where accelerations are evaluated.
        earlier: usize,
    },
    /// After every kick, and at the end of a Runge–Kutta step: velocities are constrained.
    AfterKick,
    /// After every drift, by `factor` of the step: positions are constrained.
    AfterDrift {
        /// The part of the step.
        factor: f64,
    },
    /// The same after a part of the step that was no drift, such as that of a Runge–Kutta or an implicit method: x − c v dt need not be its
    /// start.
    AfterAdvance {
        /// The part of the step.
        factor: f64,
    },
    /// Where the length of the next step is found: kernels that fill [`STEP_CRITERIA`](crate::kernel::STEP_CRITERIA), from accelerations,
    /// positions and velocities at the end of a step.
    StepLimit,
    /// Once at the start of each step, before the integrator's own kernels.
    StartOfStep,
    /// Once at the end of each step.
    EndOfStep,
    /// After that, where a component needs the pressure: it was measured, if it was due.
    Pressure,
    /// Where the virial is measured, after an evaluation: kernels that add that of what is not in its laws.
    Virial {
        /// As where accelerations are evaluated.
        earlier: usize,
    },
}

/// Properties of a component that depend only on its settings.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Properties {
    /// The radius \[length\] and the species, if not all, for the statistics of a flock: order, neighbours and clusters.
    pub statistics_radius: Option<(f64, Option<u32>)>,
    /// The obstacle that pictures show for it.
    pub pictured: Option<Standing>,
    /// Whether massless particles exert no force: then pending and removed particles may be among its sources.
    pub ignores_massless: bool,
    /// The reason for requiring a fixed time step, if it does.
    pub fixed_step: Option<&'static str>,
    /// Whether it has history that each evaluation advances by a step, beside that of its laws.
    pub history: bool,
    /// The materials with which particles touch.
    pub touches: Vec<Material>,
    /// How pedestrians press and rub.
    pub presses: Option<Press>,
    /// Whether it leads to the exits of a floor plan.
    pub navigates: bool,
    /// Whether it gives pedestrians a direction that they desire.
    pub leads: bool,
    /// Whether it sets velocities after all forces: what other forces do to its particles is lost.
    pub sets_velocities: bool,
    /// Whether it keeps pedestrians on the floor of a plan.
    pub keeps_in: bool,
    /// How it changes bodies that collide, at the end of a step.
    pub collides: Option<Collisions>,
    /// Whether it removes particles.
    pub removes: bool,
    /// Whether it breaks bonds.
    pub breaks_bonds: bool,
    /// Whether it is evaluated after all others, wherever it is in the scene.
    pub evaluated_last: bool,
    /// Whether it keeps rods at their lengths.
    pub keeps_rods: bool,
    /// Whether it keeps links from being long other than by forces: no virial has what it does.
    pub limits_links: bool,
    /// Whether it changes positions or velocities other than by accelerations, so that neither energy nor momentum is conserved.
    pub constrains: bool,
    /// Its mechanisms that change the measured energy, in a word or two each, in addition to those of its laws.
    pub dissipates: Vec<&'static str>,
    /// The same, where some particles are fixed.
    pub dissipates_at_walls: Vec<&'static str>,
    /// Whether it is a thermostat of all particles: a simulation has one at most.
    pub thermostat: bool,
    /// The temperature k T of the states that it leads to \[energy\].
    pub temperature: Option<f64>,
    /// Whether these states have the canonical distribution of that temperature.
    pub canonical: bool,
    /// Whether it is a barostat, which changes the box.
    pub barostat: Option<Pressed>,
    /// Whether it needs the forces of the positions at which a step begins: `ends_with_forces` of the integrator.
    pub needs_forces: bool,
    /// Its mechanisms that change the angular momentum, in a word or two each, in addition to those of its laws.
    pub turns: Vec<&'static str>,
    /// Whether it makes all particles that are not fixed a fluid.
    pub makes_fluid: bool,
    /// Whether it can limit the time step, so that steps can be adaptive.
    pub limits_steps: bool,
    /// The integrators with which it agrees with its paper; empty: all of them.
    pub integrators: &'static [&'static str],
    /// The maximum distance that a particle may move in a step, if its method has such a bound \[length\].
    pub largest_move: Option<f64>,
    /// Columns with an upper limit: above it the results of the component would be wrong.
    pub largest: Vec<Largest>,
    /// Whether it sums over waves of the box, of which a larger box has more.
    pub has_waves: bool,
    /// The column, a scalar, whose sum over all particles a uniform background neutralizes.
    pub neutralized: Option<&'static str>,
    /// The softening length of its forces, by which block time steps are limited \[length\].
    pub softening: Option<f64>,
    /// The expansion of space, where its forces are those of comoving coordinates.
    pub expands: Option<Expands>,
    /// A remark for the user before a run.
    pub caution: Option<&'static str>,
}

/// An expanding space, and the comoving mean density with which it expands as it does.
#[derive(Debug, Clone, PartialEq)]
pub struct Expands {
    /// Its expansion.
    pub expansion: Arc<Expansion>,
    /// The comoving mean density of matter \[mass / length³\].
    pub density: f64,
}

/// How a barostat changes the box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pressed {
    /// The number of steps from one change to the next, for each of which it needs the pressure.
    pub every: u32,
    /// The relaxation time of the pressure \[time\].
    pub time: f64,
}

/// Integrals of a pair potential U from its cut-off radius R on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tail {
    /// The two species, in one order only.
    pub species: [u32; 2],
    /// ∫ U r² dr \[energy length³\].
    pub energy: f64,
    /// ∫ U′ r³ dr \[energy length³\].
    pub slope: f64,
}

/// What becomes of bodies that collide, and how they are found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Collisions {
    /// The speed at which two part, over that at which they approach; none where they merge.
    pub restitution: Option<f64>,
    /// The distance within which they are searched at the end of a step \[length\]; none: all pairs.
    pub range: Option<f64>,
}

/// The largest value that a column may have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Largest {
    /// The column, a scalar.
    pub column: &'static str,
    /// The value, in the column's unit.
    pub value: f64,
    /// The reason for the limit.
    pub why: &'static str,
}

/// Properties of a component in a problem.
#[derive(Default)]
pub struct Resolved {
    /// The cell lists that it searches, and whether it reads velocities there.
    pub cell_lists: Vec<(Grid, bool)>,
    /// The fluid that it makes of all particles that are not fixed.
    pub fluid: Option<Continuum>,
    /// The maximum rates of oscillation and creep of that fluid.
    pub rates: Option<Rates>,
    /// The initial projection of a particle of a species, if there are positions that the component does not allow.
    pub initial_projection: Option<Projection>,
    /// With adaptive steps: the number of steps per longest step that viscosity requires, which is the same for all particles.
    pub viscous_steps: Option<f64>,
}

/// The projected position of a particle of a species.
pub type Projection = Box<dyn Fn(u32, DVec3) -> DVec3 + Send + Sync>;

/// Adds the kernels of laws to a plan; `earlier` counts the components of their kind before them. Laws that write rates of columns advanced
/// with positions are left to [`carry`].
///
/// # Errors
/// When a law does not compile or lacks a parameter.
pub fn evaluate(laws: Vec<Law>, earlier: usize, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
    add(laws.into_iter().filter(|law| !carries(law, problem)), earlier, plan, problem)
}

/// Adds the kernels of laws that write rates of columns advanced with positions.
///
/// # Errors
/// When a law does not compile or lacks a parameter.
pub fn carry(laws: Vec<Law>, earlier: usize, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
    add(laws.into_iter().filter(|law| carries(law, problem)), earlier, plan, problem)
}

fn add(laws: impl Iterator<Item = Law>, earlier: usize, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
    for law in laws {
        let law = law.after(earlier);
        plan.push(&law.name.clone(), || law.kernel(problem))?;
    }
    Ok(())
}

/// Whether a law writes the rate of a column that is advanced with positions.
#[must_use]
pub fn carries(law: &Law, problem: &Problem) -> bool {
    let mut pairs = problem.columns.pairs().into_iter();
    pairs.any(|pair| pair.way == Way::Carried && law.into.contains(&pair.rate.name))
}

/// The number of components of the same kind before a component: two of one kind have separate kernels and columns.
#[must_use]
pub fn earlier(all: &[Box<dyn Component>], place: usize) -> usize {
    let kind = |one: &dyn Component| one.laws().first().map_or_else(|| one.name().to_owned(), |law| law.name.clone());
    let own = kind(all[place].as_ref());
    all[..place].iter().filter(|other| kind(other.as_ref()) == own).count()
}

/// All columns that components declare.
pub fn declared(all: &[Box<dyn Component>]) -> impl Iterator<Item = Column> {
    let own = |place: usize| all[place].own_columns(earlier(all, place));
    all.iter().enumerate().flat_map(move |(place, one)| one.columns().into_iter().chain(own(place)))
}

/// The role of a component.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Role {
    /// It accelerates particles, or computes columns of them.
    Interaction,
    /// It projects positions or velocities.
    Constraint,
    /// It acts between steps.
    Updater,
}

/// A line of a register.
pub struct Entry {
    /// Its name in scenes.
    pub name: &'static str,
    /// One line for a list.
    pub about: &'static str,
    /// Its settings.
    pub keys: &'static [Key],
    /// Its role.
    pub role: Role,
    /// Builds one, from checked settings. An unknown setting is an error of every simulation with it.
    pub build: fn(&Settings) -> Box<dyn Component>,
}
