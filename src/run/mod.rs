//! Runs: a scene is run to its end, its outputs are written, and it can continue after it was stopped or killed.
//!
//! ```no_run
//! use motes::run::{Options, Run};
//! use motes::scene::{self, Scene, Source};
//! use motes::{Cpu, Simulation};
//!
//! # async fn example() -> Result<(), Box<dyn std::error::Error>> {
//! let mut scene = Scene::load(&Source::find("kepler")?, &[], &scene::Options::default())?;
//! let setup = scene.setup();
//! let mut run = Run::new(scene, &setup, Options::into("out/kepler"))?;
//! let mut simulation = Simulation::on(Cpu::new(setup.check()?)?, &setup)?;
//! let end = run.drive(&mut simulation, &mut ()).await?;
//! println!("{} steps; {} states are in out/kepler", end.steps, run.energies().len());
//! # Ok(())
//! # }
//! ```

mod checkpoint;
mod corrections;
mod course;
mod film;
mod folder;
mod from;
mod images;
mod looks;
mod measured;
mod outputs;
mod packed;
mod pictures;
#[doc(hidden)]
#[cfg(feature = "images")]
pub mod plot;
mod progress;
mod resume;
mod schedule;
mod states;
mod stop;
mod stream;
mod table;
mod writer;

use std::path::PathBuf;
use std::sync::Arc;

use web_time::{Duration, Instant};

pub use checkpoint::Checkpoint;
#[doc(hidden)]
pub use course::{Course, begun};
#[doc(hidden)]
pub use film::Film;
#[doc(hidden)]
pub use folder::Folder;
pub use from::go_on;
#[doc(hidden)]
pub use looks::Looks;
#[doc(hidden)]
pub use measured::Measured;
#[doc(hidden)]
pub use pictures::Pictures;
pub use progress::Progress;
#[doc(hidden)]
pub use resume::{Found, is_of};
#[doc(hidden)]
pub use states::{States, written};
pub use stop::Stop;
#[doc(hidden)]
pub use table::{Lengths, Rows, Table};
pub use writer::Writer;

pub use crate::measure::Moment;

use crate::crowds::CORRECTIONS;
use crate::error::Error;
use crate::formats::{self, Precision};
use crate::kernel::{Backend, Bounds, Columns, POSITION, Side};
use crate::measure::Times;
use crate::render::{Picture, Trail};
use crate::scene::Scene;
use crate::simulation::{Levels, Setup, Simulation};
use crate::state::State;
use packed::Packed;
use schedule::Schedule;
use stream::Stream;

/// The target duration of a batch of steps: a request to stop is checked between two.
const BATCH: Duration = Duration::from_millis(250);
/// The minimum time between two measurements of the energy for a progress bar.
const LOOK: Duration = Duration::from_secs(1);

/// Options of a run in addition to those of its scene.
#[derive(Debug, Clone)]
pub struct Options {
    /// The folder for results.
    pub output: PathBuf,
    /// Whether existing results of an earlier run are removed.
    pub overwrite: bool,
    /// Whether the ledger of a fluid, `fluid.csv`, gets a row after every step.
    pub ledger: bool,
    /// The frame rate of a film \[1/s\].
    pub fps: u16,
    /// A description of the device: adapter and driver.
    pub device: String,
    /// Double for the references, which compute in 64 bits.
    pub precision: Precision,
    /// The file of the state with which it begins, if it is not that of the scene: see [`go_on`].
    pub from: Option<PathBuf>,
    /// Requests to stop it early.
    pub stop: Stop,
}

impl Options {
    /// The default options of a run on a device, into this folder.
    #[must_use]
    pub fn into(output: impl Into<PathBuf>) -> Self {
        Self {
            output: output.into(),
            overwrite: false,
            ledger: false,
            fps: 30,
            device: "a device".to_owned(),
            precision: Precision::Single,
            from: None,
            stop: Stop::default(),
        }
    }
    /// The options that affect results, a line each.
    fn also(&self) -> String {
        format!("fps = {}\nledger = {}\n", self.fps, self.ledger)
    }
}

/// Whether there is a box.
fn has_sides(bounds: &Bounds) -> bool {
    bounds.sides.iter().any(|side| *side != Side::Open)
}

/// A run of a scene.
pub struct Run {
    scene: Scene,
    options: Options,
    /// The number of steps of dt before it begins.
    begun: u64,
    count: usize,
    columns: Columns,
    packed: Packed,
    /// The thread that writes files.
    stream: Stream,
    /// The folder, held until this is dropped.
    folder: Option<Arc<Folder>>,
    /// The checkpoint from which it continues, until it has.
    resumed: Option<Checkpoint>,
    /// The number of steps of dt done when it continued.
    goes_on: Option<u64>,
    schedule: Schedule,
    /// The measures at outputs, in the order of the register.
    pub measures: Vec<Measured>,
    /// Pictures of outputs.
    pub pictures: Pictures,
    /// The film, if there is one.
    pub film: Option<Film>,
    /// The statistics of the energies.
    pub looks: Looks,
    /// Additional writers, which receive every output.
    pub writers: Vec<Box<dyn Writer>>,
    states: States,
    /// The progress.
    pub course: Option<Course>,
    /// The number of springs at the start, and the present one, where they may break.
    pub springs: (usize, Option<usize>),
    /// The block time steps of the run, where particles have steps of their own.
    pub levels: Option<Levels>,
    /// The last state that was read, which is the last one known to be valid.
    pub last: Option<Arc<State>>,
}

/// The end of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct End {
    /// Whether it was stopped before its last step; it can continue from the checkpoint that was written then.
    pub stopped: bool,
    /// The number of steps since it began, or continued.
    pub steps: u64,
    /// The duration of these, without measurements and files.
    pub stepping: Duration,
}

impl Run {
    /// A run of a scene with this setup.
    ///
    /// # Errors
    /// [`Error::Output`] when the folder contains files that must not be replaced, [`Error::Input`] when a file of the scene is missing,
    /// and errors of pictures.
    pub fn new(scene: Scene, setup: &Setup, options: Options) -> Result<Self, Error> {
        Folder::examine(&options.output, &scene.name, &scene.files, options.overwrite)?;
        Self::of(scene, setup, options, None)
    }
    /// A run of a scene, into a folder that is or will be locked.
    fn of(scene: Scene, setup: &Setup, mut options: Options, folder: Option<Arc<Folder>>) -> Result<Self, Error> {
        if setup.integrator.precision().is_double() {
            options.precision = Precision::Double;
        }
        let packed = Packed::of(&scene, options.also(), options.from.as_deref())?;
        let begun = course::begun(&scene, &setup.state);
        let scenery = pictures::scenery(setup);
        images::check(&scene.output)?;
        Picture::with(&scene.picture, &setup.state, &[], Trail::new(0), &scenery)?;
        let (count, stream) = (setup.state.len(), Stream::default());
        let mut measures = Measured::all(&scene.measures, setup)?;
        measures.iter_mut().for_each(|one| one.each_step = options.ledger && one.measure.times == Times::Ledger);
        Ok(Self {
            begun,
            count,
            columns: setup.columns()?,
            packed,
            folder,
            resumed: None,
            goes_on: None,
            schedule: Schedule::new(scene.checkpoint.every, setup.state.step, setup.state.time),
            measures,
            pictures: Pictures::new(&scene, count, (scenery, setup.bounds), stream.clone()),
            film: Film::of(&scene, begun, options.fps, &stream),
            looks: Looks::new(scene.steps, scene.adaptive_step.is_some()),
            writers: Vec::new(),
            states: States::new(
                &scene.output.formats,
                formats::Options {
                    precision: options.precision,
                    bounds: Some(setup.bounds).filter(has_sides),
                    compress: scene.output.compress,
                    part: formats::Part { number: 0, of: scene.output.files },
                },
                scene.steps,
                stream.clone(),
            ),
            stream,
            course: None,
            springs: (setup.state.links.springs.len(), None),
            levels: None,
            last: None,
            scene,
            options,
        })
    }
    /// The scene, without its particles and forces.
    #[must_use]
    pub fn scene(&self) -> &Scene {
        &self.scene
    }
    /// The number of particles.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }
    /// Its options.
    #[must_use]
    pub fn options(&self) -> &Options {
        &self.options
    }
    /// Runs a simulation of the scene to its end, and writes its outputs.
    ///
    /// # Errors
    /// Errors of the simulation, and [`Error::Output`] when a result cannot be written. The last checkpoint is kept, if there is one.
    pub async fn drive<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        progress: &mut dyn Progress,
    ) -> Result<End, Error> {
        let end = self.whole(simulation, progress).await;
        // Whatever ended the run, outputs up to then are written.
        let written = self.stream.drain();
        end.and_then(|end| written.map(|()| end))
    }
    async fn whole<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        progress: &mut dyn Progress,
    ) -> Result<End, Error> {
        // All checks are done: from here on files are written.
        let folder = self.open(progress)?;
        if simulation.steps() > 0 || simulation.goes_on() {
            let time = simulation.clock().await?.map_or(simulation.steps() as f64 * self.scene.dt, |clock| clock.time);
            progress.remark(&from::remark(simulation.goes_on(), simulation.steps(), time));
        }
        let mut course = Course::of(&self.scene, simulation).await?;
        let begun = simulation.steps();
        if let Some(done) = self.goes_on {
            course.go_on(done);
        } else {
            self.write(simulation, &course, progress).await?;
            self.shoot(simulation, &course, &folder, progress).await?;
        }
        self.schedule = Schedule::new(self.scene.checkpoint.every, simulation.steps(), course.time());
        let stepping = self.advance(simulation, &mut course, &folder, progress).await?;
        self.levels = simulation.levels().await?;
        let stopped = course.done() < self.scene.steps;
        if stopped {
            // Before the files that only a stopped run writes.
            self.save(simulation, &course, progress).await?;
        }
        if self.energies().last().is_none_or(|row| row.step != simulation.steps()) {
            self.write(simulation, &course, progress).await?;
        }
        if simulation.columns().get(CORRECTIONS).is_some()
            && let Some(text) = corrections::corrected(&simulation.snapshot().await?)
        {
            progress.warning(&text);
        }
        let steps = simulation.steps() - begun;
        if let Some(film) = &mut self.film {
            film.develop(simulation, (&self.pictures, &folder), progress).await?;
            film.join(&folder)?;
        }
        self.stream.drain()?;
        for writer in self.all() {
            writer.finish()?;
        }
        images::energy(&folder.file("energy.svg")?, self.energies(), &self.scene.name)?;
        if !stopped {
            self.sign(&folder, Some(simulation.steps()))?;
            folder.keep_checkpoints(0, u64::MAX)?;
        }
        self.course = Some(course);
        Ok(End { stopped, steps, stepping })
    }
    /// Steps until the run ends or is stopped. Returns the duration of the steps.
    async fn advance<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        course: &mut Course,
        folder: &Arc<Folder>,
        progress: &mut dyn Progress,
    ) -> Result<Duration, Error> {
        let (steps, every, dt) = (self.scene.steps, self.scene.output.every, self.scene.dt);
        let (mut batch, mut stepping) = (1, Duration::ZERO);
        let (mut looked, mut look) = (Instant::now(), Duration::ZERO);
        while course.done() < steps && !self.options.stop.asked(self.schedule.took) {
            let (done, made) = (course.done(), simulation.steps());
            let next = ((done / every + 1) * every).min(steps);
            let frame = self.film.as_ref().and_then(Film::next).unwrap_or(steps);
            let point = self.pictures.until_point(made).unwrap_or(u64::MAX);
            let most = point.min(self.schedule.most(made, course.time(), dt));
            let most = if self.measures.iter().any(|one| one.each_step) { 1 } else { most };
            let start = Instant::now();
            let measured = self.measures.iter().map(|one| one.next(done)).min().unwrap_or(u64::MAX);
            let target = next.min(frame).min(measured).min(self.looks.next(done));
            let some = course.advance(simulation, target, batch.min(most)).await?;
            stepping += start.elapsed();
            let factor = (BATCH.as_secs_f64() / start.elapsed().as_secs_f64().max(1e-6)).clamp(0.5, 4.0);
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "a size of batches, at least one"
            )]
            if some == batch || factor < 1.0 {
                batch = ((batch as f64 * factor) as u64).clamp(1, 1 << 20);
            }
            if self.pictures.points_at(simulation.steps()) {
                let positions = simulation.read(POSITION).await?;
                let positions: Vec<_> = positions.iter().map(|x| x.as_dvec4().truncate()).collect();
                self.pictures.trail.push(&positions);
            }
            progress.at(course.done());
            self.stream.check()?;
            if course.done() == next {
                self.write(simulation, course, progress).await?;
            } else if self.measures_between(course.done()) {
                self.enter(simulation, course, progress).await?;
            } else if self.looks.is_due(course.done()) || progress.watched() && looked.elapsed() > LOOK.max(look * 20) {
                // The energy between two outputs, and for a progress bar for a twentieth of the time at most.
                let start = Instant::now();
                let snapshot = Arc::new(simulation.snapshot().await?);
                self.look(snapshot, course, progress)?;
                (looked, look) = (Instant::now(), start.elapsed());
            }
            self.shoot(simulation, course, folder, progress).await?;
            if course.done() < steps && self.schedule.is_due(simulation.steps(), course.time()) {
                self.save(simulation, course, progress).await?;
            }
        }
        Ok(stepping)
    }
    /// Takes the present state for the film, if a frame is due.
    async fn shoot<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        course: &Course,
        folder: &Arc<Folder>,
        progress: &mut dyn Progress,
    ) -> Result<(), Error> {
        match &mut self.film {
            Some(film) if film.next() == Some(course.done()) => {
                film.shoot(simulation, course.done(), (&self.pictures, folder), progress).await
            }
            _ => Ok(()),
        }
    }
}
