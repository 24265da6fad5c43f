//! A simulation: particles, forces and an integrator on a backend.

mod adaptive_step;
mod alarm;
mod barostat;
mod blocks;
mod columns;
mod elastic;
mod fields;
mod grow;
mod inactive;
mod initial_projection;
mod lists;
mod pair_history;
#[cfg(feature = "render")]
mod pictures;
mod population;
mod pressures;
mod readback;
mod restart;
mod rows;
mod set;
mod setup;
mod skin;
mod solves;
mod spawn;
mod tables;
mod ties;
mod unwritten;
mod virial;

pub use adaptive_step::{Clock, refuses_own_steps};
pub use blocks::{Levels, refuses_blocks};
pub use inactive::serves;
pub use pressures::PressureSolves;
pub use readback::Readback;
pub use setup::{Plans, Setup};
#[doc(hidden)]
pub use skin::ListReport;
pub use solves::{Outcome, Solves, Unsettled};

use crate::cpu::threads;
use crate::error::Error;
use crate::gpu::Gpu;
use crate::integrators::{RADAU_STEP, SOLVE_REPORT};
use crate::kernel::{AdaptiveStep, Array, Backend, Element, Field, HOME, ListShape, POSITION, Plan, Problem, VELOCITY};
use crate::sph::DFSPH_REPORT;
use crate::state::State;
use columns::Store;
use fields::Fields;
use glam::DVec3;
use restart::Carried;
use rows::Rows;
use std::collections::BTreeMap;
use ties::Ties;

/// The initial state of a simulation.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Start {
    /// A state given by the caller.
    Anew,
    /// All rows of another simulation.
    Grown,
}

/// A simulation of particles on a backend.
pub struct Simulation<B: Backend> {
    backend: B,
    start: B::Program,
    /// Whether the start plan has run for the current state.
    begun: bool,
    /// Whether forces make something of the state then, such as the masses of walls: what is measured has it.
    begins: bool,
    step: B::Program,
    measure: (B::Program, B::Program),
    plan: String,
    /// The marks by which alarms name users' laws.
    marks: alarm::Marks,
    /// Whether a step keeps a report of its implicit solves, and one of its pressure solves.
    reports: [bool; 3],
    /// The setup without its state, from which plans are rewritten for more rows; and the number of times this was done.
    setup: Setup,
    generation: u32,
    /// Rows that were in use when a plan was first written for this run.
    first_rows: u32,
    rows: Rows,
    store: Store,
    /// Links, motions, births and drains as the setup gave them, and whether springs may have broken since.
    ties: Ties,
    breaks: bool,
    /// The number of rows that may be spawned or removed: all, or none.
    inactive: u32,
    dt: f64,
    /// The adaptive time step; `None`: all steps have the same length.
    adaptive_step: Option<AdaptiveStep>,
    /// The neighbour list that laws share, if any.
    list: Option<ListShape>,
    repeat: lists::Repeat,
    skin: skin::Watched,
    steps: u64,
    /// Restart data that a step saves for the next one beside columns, and a hash of this step.
    carried: Vec<Carried>,
    print: u64,
    /// Whether the simulation continued from a state with complete restart data.
    goes_on: bool,
    /// The extent of the particles at the start of the run, and the number of fixed ones whose initial positions are stored.
    extent: (DVec3, DVec3),
    anchored: usize,
    /// The problem that the plans were written for, and the plans: a change of a setting rewrites them.
    problem: Box<Problem>,
    plans: Box<Plans>,
    /// The fields that the plans name.
    fields: Fields,
    /// The largest values of columns that forces limit.
    largest: BTreeMap<&'static str, setup::Largest>,
}

impl<B: Backend> Simulation<B> {
    /// Creates a simulation on a backend. It starts at the time and the step of the setup's state: see
    /// [`Simulation::snapshot`] and [`State::begin_anew`].
    ///
    /// # Errors
    /// When the setup is invalid, a shader does not compile, the fields do not fit the device, or no thread can be started.
    pub fn on(backend: B, setup: &Setup) -> Result<Self, Error> {
        Self::going(backend, setup, Start::Anew)
    }
    fn going(mut backend: B, given: &Setup, how: Start) -> Result<Self, Error> {
        threads()?;
        let stretched = given.stretched()?;
        let given = stretched.as_ref().unwrap_or(given);
        let padded = given.padded();
        let setup = padded.as_ref().unwrap_or(given);
        let count = setup.check()?;
        if padded.is_some() {
            backend.resize(count);
        }
        let problem = setup.problem(backend.machine())?;
        setup.weighs(&problem)?;
        let plans = setup.plans_of(&problem)?;
        let (plan, marks, largest) = (plans.step.to_string(), alarm::marks(&plans), setup.largest(&BTreeMap::new()));
        let reports = [SOLVE_REPORT, DFSPH_REPORT, RADAU_STEP.name]
            .map(|name| plans.step.kernels.iter().any(|kernel| kernel.names(name)));
        let (list, fields) = (plans.list, Fields::of(&plans, count));
        let repeat = lists::Repeat::of(&plans, list);
        let start = backend.compile(&plans.start)?;
        let step = backend.compile_often(&plans.step)?;
        let measure = (backend.compile(&plans.measure.0)?, backend.compile(&plans.measure.1)?);
        let state = &setup.state;
        let store = Store::new(setup, &plans, count)?;
        let print = restart::print(&plans.step, &problem);
        let whole = how == Start::Grown || restart::is_whole(print, &given.state);
        store.write(&mut backend, setup, whole)?;
        let anchored = plans.all().any(|plan| plan.fields(count).contains_key(HOME.name));
        let anchored = if anchored { Store::anchor(&mut backend, setup)? } else { 0 };
        let carried = restart::carried(&plans, store.columns(), count);
        let extent = setup.extent();
        let ties = Ties::of(state);
        let (has_inactive, breaks) = (setup.has_inactive(), setup.breaks());
        let (begun, begins) = (false, setup.begins(&problem)?);
        let (dt, steps, adaptive_step) = (setup.dt, state.step, setup.integrator.adaptive_step());
        let mut made = Self {
            backend,
            start,
            begun,
            begins,
            step,
            measure,
            plan,
            marks,
            reports,
            setup: given.with_state(State::default()),
            generation: 0,
            first_rows: count.saturating_sub(setup.free()).max(1),
            rows: Rows::of(state, count),
            store,
            ties,
            breaks,
            inactive: if has_inactive { count } else { 0 },
            dt,
            adaptive_step,
            list,
            repeat,
            skin: skin::Watched::from(steps),
            steps,
            carried,
            print,
            goes_on: false,
            extent,
            anchored,
            problem: Box::new(problem),
            plans: Box::new(plans),
            fields,
            largest,
        };
        made.unstop()?;
        made.recall_pairs(state)?;
        made.resume(setup, whole)?;
        Ok(made)
    }
    /// Advances by a number of steps. It may return before the device is done; reading waits. At most two submissions of about 80 ms are in
    /// flight: further steps wait for the device. A program that must not wait submits few steps at a time, or uses [`Simulation::encode`].
    ///
    /// If a neighbour list overflows, [`Simulation::check`] and every call that waits for a read enlarge it and repeat the steps since the
    /// previous check, with the bits of a run that had the capacity from the start. The more steps lie between two checks, the more are
    /// repeated; steps after which a caller has written fields or encoded steps cannot be repeated, and end in
    /// [`Error::ListFull`].
    ///
    /// # Errors
    /// When the device is lost, out of memory, or does not answer in time.
    pub fn step(&mut self, steps: u32) -> Result<(), Error> {
        self.room(steps)?;
        self.repeatable(Some(steps))?;
        self.begin()?;
        self.backend.run(&self.step, steps)?;
        self.steps += u64::from(steps);
        Ok(())
    }
    /// Runs the start plan before the first step, if it has not run yet.
    fn begin(&mut self) -> Result<(), Error> {
        if !self.begun {
            self.backend.run(&self.start, 1)?;
            self.begun = true;
        }
        Ok(())
    }
    /// The device counts steps in 32 bits.
    fn room(&self, steps: u32) -> Result<(), Error> {
        if self.steps + u64::from(steps) > u64::from(u32::MAX) {
            let text =
                format!("{} steps are done, the maximum is {}: start a new run from a snapshot", self.steps, u32::MAX);
            return Err(Error::Scene(text));
        }
        Ok(())
    }
    /// Reads a field, one element for each row in use. It waits for all submitted steps; [`Simulation::request`] does not wait.
    ///
    /// # Errors
    /// When there is no such field, the device is lost, or it does not answer in time.
    pub async fn read<T: Element>(&mut self, field: Field<T>) -> Result<Vec<T>, Error> {
        let like = T::array(Vec::new());
        let len = self.len_of(field, &like)?;
        self.settle().await?;
        let array = self.backend.read(field.name, &like, len).await?;
        Ok(T::view(&array).map_or_else(Vec::new, |values| values.iter().map(|v| T::narrow(*v)).collect()))
    }
    /// The number of elements of a field that are read: those of rows in use, or all where there are fewer than rows, as in a user's table.
    fn len_of<T>(&self, field: Field<T>, like: &Array) -> Result<usize, Error> {
        let (all, rows) = (self.fields.len(field.name, like)?, self.rows.capacity() as usize);
        Ok(if all < rows { all } else { self.rows.used() as usize })
    }
    /// Requests a field as it is after all submitted steps, one element for each row in use, and returns immediately: the values are
    /// polled in a later frame, or awaited elsewhere. A request borrows nothing, several may be in flight, and a dropped one costs
    /// nothing. Steps that a caller has encoded count once they are submitted.
    ///
    /// # Errors
    /// When there is no such field, or the device is lost.
    ///
    /// It does not check the neighbour list: see [`Simulation::step`], and call [`Simulation::check`] regularly.
    pub fn request<T: Element>(&mut self, field: Field<T>) -> Result<Readback<T>, Error> {
        let like = T::array(Vec::new());
        let len = self.len_of(field, &like)?;
        let arrival = self.backend.request(field.name, &like, len)?;
        Ok(Readback::new(arrival))
    }
    /// Writes a field from its first element on, such as a kinematic target. If positions or velocities change, the next step
    /// starts with accelerations that are evaluated again.
    ///
    /// # Errors
    /// When there is no such field, it is shorter, or the device is lost.
    pub fn write<T: Element>(&mut self, field: Field<T>, values: &[T]) -> Result<(), Error> {
        self.write_at(field, 0, values)
    }
    /// Writes a field from the element `first` on.
    ///
    /// # Errors
    /// When there is no such field, it ends before, a number for a column of the state is not finite, it is the clock or the life of
    /// particles, which [`Simulation::spawn`] and [`Simulation::remove`] keep, or the device is lost.
    pub fn write_at<T: Element>(&mut self, field: Field<T>, first: usize, values: &[T]) -> Result<(), Error> {
        let array = T::array(values.iter().map(|v| v.widen()).collect());
        self.fields.hold(field.name, &array, first)?;
        self.may_write(field.name, &array, first)?;
        self.unrepeatable();
        self.begun &= field.name != POSITION.name && field.name != VELOCITY.name;
        self.store.fill(&mut self.backend, field.name, first, &array)
    }
    /// The state at the end of the last step, with the column `potential` and all links, motions, births and drains. It
    /// evaluates the forces once more, which does not change the run.
    ///
    /// A setup of it continues from there: at its time and step, with the same bits as if the run had never stopped, under the same
    /// forces, integrator and step length on the same device; [`Simulation::goes_on`] says whether it did. Where positions, velocities
    /// or other columns of the state are changed, accelerations are evaluated again, and the clock continues all the same.
    /// [`State::begin_anew`] puts it back to time 0.
    ///
    /// # Errors
    /// [`Error::NotFinite`], [`Error::TooManyNeighbors`], or what reading says. Speeds that run away are no error here.
    pub async fn snapshot(&mut self) -> Result<State, Error> {
        self.snapshot_of(&[]).await
    }
    /// Like [`Simulation::snapshot`], with these other columns, which have the values of the present state.
    ///
    /// # Errors
    /// [`Error::Scene`] when there is no such column, or nothing computes it; and those of [`Simulation::snapshot`].
    pub async fn snapshot_of(&mut self, columns: &[&str]) -> Result<State, Error> {
        self.settle().await?;
        let (state, alarm) = loop {
            self.begin_measurement().await?;
            let state = self.gathered(&[columns, &["potential"]].concat()).await;
            if let Some(alarm) = self.end_measurement().await? {
                break (state, alarm);
            }
        };
        self.sound(&alarm)?;
        let mut state = state?;
        self.complete(&mut state).await?;
        let mut state = self.compacted(state);
        self.mark(&mut state);
        Ok(state)
    }
    /// Adds to a state of columns everything else that a state holds.
    async fn complete(&mut self, state: &mut State) -> Result<(), Error> {
        self.ties.give(state);
        let all = std::mem::replace(&mut state.links, self.links_now().await?);
        state.time = self.clock_now().await?.map_or(self.steps as f64 * self.dt, |clock| clock.time);
        state.step = self.steps;
        self.keep(state, &all).await?;
        self.keep_pairs(state).await
    }
    /// One step, as `motes explain` prints it.
    #[must_use]
    pub fn plan(&self) -> &str {
        &self.plan
    }
    /// The plan of one step, and for how many rows it was written.
    #[doc(hidden)]
    #[must_use]
    pub fn step_plan(&self) -> (&Plan, u32) {
        (&self.plans.step, self.rows.capacity())
    }
    /// Steps done.
    #[must_use]
    pub fn steps(&self) -> u64 {
        self.steps
    }
    /// Rows in use: one for each particle, and those that have been free since one was removed. [`Simulation::ids`] tells them apart.
    #[must_use]
    pub fn count(&self) -> u32 {
        self.rows.used()
    }
    /// The number of rows allocated: particles are spawned into free ones without a new plan. See [`State::capacity`].
    #[must_use]
    pub fn capacity(&self) -> u32 {
        self.rows.capacity()
    }
    /// The number of times that its buffers were replaced, for more rows or for more neighbours of each particle.
    #[must_use]
    pub fn generation(&self) -> u32 {
        self.generation
    }
    /// Its setup without the state, with forces as they were [set](Simulation::set). With the state of
    /// [`Simulation::snapshot`] another simulation continues from here.
    #[must_use]
    pub fn setup(&self) -> &Setup {
        &self.setup
    }
    /// The backend. Whatever is run or written through it is not repeated when a neighbour list has to grow.
    pub fn backend(&mut self) -> &mut B {
        self.unrepeatable();
        &mut self.backend
    }
}

/// The interface for rendering programs: their device, queue and encoder.
impl Simulation<Gpu> {
    /// On a device that the caller owns and continues using. It needs no optional feature and nothing beyond WebGPU's default limits;
    /// [`wanted_features`](crate::gpu::wanted_features) and [`wanted_limits`](crate::gpu::wanted_limits) say what is worth asking
    /// for: speed where there are subgroups, and room for more than 8 million particles.
    ///
    /// # Errors
    /// When the setup is invalid, a shader does not compile, or the fields do not fit the device.
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, setup: &Setup) -> Result<Self, Error> {
        let gpu = Gpu::new(device, queue, setup.check()?)?;
        Self::on(gpu, setup)
    }
    /// Encodes steps into the caller's encoder and submits nothing. The clock is on the device, so every call continues
    /// where the one before it ended, if the caller submits them in that order. The caller decides how long
    /// a submission takes: systems end those of some seconds. If an encoder is dropped, its steps are lost, and the clock of the
    /// simulation is wrong: create a new one. Submit before anything is read: a read may replace buffers.
    ///
    /// # Errors
    /// [`Error::Scene`] when the steps no longer fit the device's count of them.
    pub fn encode(&mut self, steps: u32, encoder: &mut wgpu::CommandEncoder) -> Result<(), Error> {
        self.room(steps)?;
        self.unrepeatable();
        if !self.begun {
            self.backend.encode(&self.start, 1, encoder);
            self.begun = true;
        }
        self.backend.encode(&self.step, steps, encoder);
        self.steps += u64::from(steps);
        Ok(())
    }
    /// One step in one submission; the kernel of each of its dispatches, by its place in [`Simulation::step_plan`], and its seconds by the
    /// device's own clock. Without such a clock there are none, and no step.
    ///
    /// # Errors
    /// When the device is lost, or does not answer in time.
    #[doc(hidden)]
    pub async fn timed_step(&mut self) -> Result<Option<Vec<(Option<usize>, f64)>>, Error> {
        self.room(1)?;
        self.unrepeatable();
        self.begin()?;
        let times = self.backend.timed_dispatches(&self.step).await?;
        self.steps += u64::from(times.is_some());
        Ok(times)
    }
    /// One step in one pass, and its seconds by the device's own clock.
    ///
    /// # Errors
    /// When the device is lost, or does not answer in time.
    #[doc(hidden)]
    pub async fn timed_whole(&mut self) -> Result<Option<f64>, Error> {
        self.room(1)?;
        self.unrepeatable();
        self.begin()?;
        let time = self.backend.timed(&self.step, 1).await?;
        self.steps += u64::from(time.is_some());
        Ok(time)
    }
    /// A field's buffer, usable as a vertex buffer: draw without a copy. It stays the same until the simulation makes room for
    /// more rows or neighbours, as [`Simulation::generation`] shows.
    #[must_use]
    pub fn buffer<T>(&self, field: Field<T>) -> Option<&wgpu::Buffer> {
        self.backend.buffer(field.name)
    }
}
