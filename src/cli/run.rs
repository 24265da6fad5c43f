//! `motes run`

mod conclude;

use std::path::PathBuf;
use std::rc::Rc;
use std::time::{Duration, Instant};

use motes::formats::{Folder, Precision};
use motes::kernel::Backend;
use motes::render::{Image, Picture, Scenery, Trail};
use motes::scene::Scene;
use motes::{Cpu, Error, Measure, POSITION, Setup, Simulation, State};
use serde_json::json;

use super::advice::{Conserved, advice, conserved};
use super::args::RunArgs;
use super::course::{self, Course};
use super::engine::Engine;
use super::failure::Failure;
use super::film::Film;
use super::from;
use super::ledger::Book;
use super::looks::Looks;
use super::output::Output;
use super::progress::Progress;
use super::solves;
use super::stop::Stop;
use super::substeps::{self, Loaded};
use super::summary;

/// How long one batch of steps should take: Ctrl-C is heard between two.
const BATCH: Duration = Duration::from_millis(250);
/// Between two looks at the energy, at least.
const LOOK: Duration = Duration::from_secs(1);
/// How many points a trail gets, about.
const TRAIL: u64 = 1000;

/// Runs a scene.
pub async fn run(args: &RunArgs) -> Result<(), Failure> {
    let frames = args.frames.map(|n| format!("output.frames={n}"));
    let Loaded { scene, mut setup, verdict, .. } = substeps::load(&args.scene, frames).await?;
    if let Some(path) = &args.from {
        from::go_on(&mut setup, &scene, path)?;
    }
    let count = setup.check()?;
    let engine = Engine::choose(&args.scene.device).await?;
    let folder = args.output.clone().unwrap_or_else(|| PathBuf::from("out").join(&scene.name));
    Folder::examine(&folder, &scene.name, &scene.files, args.overwrite)?;
    let mut run = Run::new(args, scene, folder, &setup, &engine)?;
    // Everything that can be refused is refused before the first file is written.
    let mut result = match &engine {
        Engine::Gpu(found) => {
            let simulation = Simulation::new(&found.device, &found.queue, &setup)?;
            let result = run.drive(simulation, Precision::Single).await;
            // What the device said outside of our calls explains what came of it.
            found.faults.check()?;
            result
        }
        Engine::Cpu(_) => run.drive(Simulation::on(Cpu::new(count)?, &setup)?, Precision::Double).await,
    };
    if let Err(Failure::Error(error)) = result {
        result = Err(run.explain(error, &setup, verdict.as_ref(), &engine));
    }
    match &result {
        Err(Failure::Error(error)) => {
            run.progress.event("error", json!({ "code": error.exit_code(), "text": error.to_string() }));
        }
        Err(Failure::Explained(error, more)) => {
            run.progress.event("error", json!({ "code": error.exit_code(), "text": error.to_string(), "more": more }));
        }
        _ => {}
    }
    if let (Err(Failure::Error(Error::Timeout { .. })), Engine::Gpu(_)) = (&result, &engine) {
        // Dropping a device that hangs would hang.
        let code = result.err().map(Failure::report);
        std::process::exit(if code.is_some() { 7 } else { 0 });
    }
    result
}

struct Run {
    scene: Scene,
    device: String,
    folder: PathBuf,
    film: Option<Film>,
    count: usize,
    /// The statistics radius, if there is one.
    flock_statistics: Option<(f64, Option<u32>)>,
    /// What pictures show beside particles.
    scenery: Scenery,
    /// What should stay as it is.
    conserved: Conserved,
    /// The ledger of a fluid, and whether it is kept at every step.
    book: Option<Book>,
    ledger: bool,
    /// Whether the results of an earlier run are removed.
    overwrite: bool,
    /// The folder, held until the last word is written.
    lock: Option<Rc<Folder>>,
    /// What was seen of the energies.
    looks: Looks,
    progress: Progress,
    stop: Stop,
    /// The last state that was read, and so the last that is known to be good.
    last: Option<State>,
    /// Springs at the start, and how many of them are torn.
    springs: usize,
    torn: Option<String>,
}

impl Run {
    fn new(args: &RunArgs, scene: Scene, folder: PathBuf, setup: &Setup, engine: &Engine) -> Result<Self, Failure> {
        let begun = course::begun(&scene, &setup.state);
        let progress = Progress::new(args, begun, scene.steps);
        let standing = setup.forces.iter().filter_map(|force| force.properties().pictured).collect();
        let scenery = Scenery::of(&setup.state).within(&scene.bounds).beside(standing, &setup.state);
        Picture::with(&scene.picture, &setup.state, &[], Trail::new(0), &scenery)?;
        let device = engine.describe();
        let count = setup.state.len();
        let film = Film::of(&scene, begun, &folder, args.fps);
        progress.event(
            "start",
            json!({ "version": env!("CARGO_PKG_VERSION"), "scene": scene.name, "particles": count, "steps": scene.steps,
                "dt": scene.dt, "integrator": scene.integrator.name, "device": device, "output": folder }),
        );
        progress.say(&format!(
            "{}: {count} particles, {} by {}",
            scene.name,
            course::words(&scene),
            scene.integrator.name
        ));
        progress.say(&format!("on {device}"));
        for remark in engine.remarks(setup)?.into_iter().chain(advice(&scene, setup)?) {
            progress.remark(&remark);
        }
        let flock_statistics = setup.forces.iter().find_map(|force| force.properties().statistics_radius);
        let (conserved, stop) = (conserved(setup)?, Stop::listen());
        let (springs, last, torn) = (setup.state.links.springs.len(), None, None);
        let (steps, adaptive) = (scene.steps, scene.adaptive_step.is_some());
        Ok(Self {
            scene,
            device,
            folder,
            film,
            count,
            flock_statistics,
            scenery,
            conserved,
            progress,
            stop,
            last,
            book: Book::of(setup)?,
            ledger: args.ledger,
            overwrite: args.overwrite,
            lock: None,
            looks: Looks::new(steps, adaptive),
            springs,
            torn,
        })
    }

    async fn drive<B: Backend>(&mut self, mut simulation: Simulation<B>, precision: Precision) -> Result<(), Failure> {
        let folder = Folder::open(&self.folder, &self.scene.name, &self.scene.files, self.overwrite)?;
        let folder = Rc::new(folder);
        self.lock = Some(folder.clone());
        if let Some(text) = folder.remark() {
            self.progress.remark(text);
        }
        let mut output = Output::new(folder, &self.scene, self.count, self.flock_statistics, precision, &self.device)?;
        output.scenery = self.scenery.clone();
        if let Some(book) = &mut self.book {
            book.open(output.folder())?;
        }
        if simulation.steps() > 0 || simulation.goes_on() {
            let time = simulation.clock().await?.map_or(simulation.steps() as f64 * self.scene.dt, |clock| clock.time);
            self.progress.remark(&from::remark(simulation.goes_on(), simulation.steps(), time));
        }
        let (steps, every) = (self.scene.steps, self.scene.output.every);
        let mut course = Course::of(&self.scene, &mut simulation).await?;
        let mut image = self.write(&mut simulation, &course, &mut output).await?;
        self.shoot(&mut simulation, &course, &output).await?;
        let (mut batch, mut stepping) = (1, Duration::ZERO);
        let (mut looked, mut look) = (Instant::now(), Duration::ZERO);
        while course.done() < steps && !self.stop.asked() {
            let done = course.done();
            let next = ((done / every + 1) * every).min(steps);
            let frame = self.film.as_ref().and_then(Film::next).unwrap_or(steps);
            let most = if output.trail.wanted() { (steps / TRAIL).max(1) } else { u64::MAX };
            let most = if self.ledger { 1 } else { most };
            let start = Instant::now();
            let target = next.min(frame).min(self.looks.next(done));
            let some = course.advance(&mut simulation, target, batch.min(most)).await?;
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
            if output.trail.wanted() {
                let positions: Vec<_> =
                    simulation.read(POSITION).await?.iter().map(|x| x.as_dvec4().truncate()).collect();
                output.trail.push(&positions);
            }
            self.progress.at(course.done());
            if course.done() == next {
                image = self.write(&mut simulation, &course, &mut output).await?;
            } else if self.ledger && self.book.is_some() {
                let snapshot = simulation.snapshot().await?;
                self.enter(&mut simulation, &course, &snapshot).await?;
            } else if self.looks.is_due(course.done())
                || self.progress.watched() && looked.elapsed() > LOOK.max(look * 20)
            {
                // The energy between two outputs, and for a bar that is watched for a twentieth of the time at most.
                let start = Instant::now();
                let snapshot = simulation.snapshot().await?;
                let row = Measure::of(&snapshot)?;
                self.progress.energy(&row, &output.first());
                if self.looks.is_due(course.done()) {
                    self.looks.take(&row);
                }
                self.last = Some(snapshot);
                (looked, look) = (Instant::now(), start.elapsed());
            }
            self.shoot(&mut simulation, &course, &output).await?;
        }
        // Ctrl-C may come at any time: what is written last is what was done last.
        if output.rows().last().is_none_or(|row| row.step != simulation.steps()) {
            image = self.write(&mut simulation, &course, &mut output).await?;
        }
        let steps = simulation.steps();
        if let Some(film) = &mut self.film {
            film.develop(&mut simulation, &output, &self.progress).await?;
        }
        let concluded = self.conclude((steps, &course), &output, stepping, image.as_ref());
        solves::tell(&self.progress, simulation.solves().await?, simulation.pressure_solves().await?);
        concluded
    }

    /// Takes the present state for the film, if it is one of its frames.
    async fn shoot<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        course: &Course,
        output: &Output,
    ) -> Result<(), Failure> {
        match &mut self.film {
            Some(film) if film.next() == Some(course.done()) => {
                film.shoot(simulation, course.done(), output, &self.progress).await
            }
            _ => Ok(()),
        }
    }

    /// Measures and writes the present state. Gives the picture, where pictures are wanted.
    async fn write<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        course: &Course,
        output: &mut Output,
    ) -> Result<Option<Image>, Failure> {
        let columns = self.scene.output.columns.clone();
        let wanted: Vec<&str> = columns.iter().map(String::as_str).collect();
        let mut snapshot = simulation.snapshot_of(&wanted).await?;
        self.enter(simulation, course, &snapshot).await?;
        output.measure(&snapshot)?;
        // The energies are in their table.
        if !wanted.contains(&"potential") {
            snapshot.remove("potential");
        }
        output.snapshot(&snapshot)?;
        if let Some(links) = simulation.torn().await? {
            output.links(snapshot.step, &links)?;
            self.torn = Some(summary::torn(self.springs, &links));
        }
        if output.rows().len() == 1 {
            output.trail.push(snapshot.position());
        }
        let mut image = None;
        if output.pictures() {
            let drawn = simulation.draw(&output.picture(&snapshot)?).await?;
            drawn.save(&output.frame(snapshot.step)?)?;
            image = Some(drawn);
        }
        if let Some(row) = output.rows().last() {
            self.looks.take(row);
            self.progress.measured(row, &output.first());
        }
        self.last = Some(snapshot);
        Ok(image)
    }

    /// Enters a state into the ledger of a fluid, if there is one.
    async fn enter<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        course: &Course,
        snapshot: &State,
    ) -> Result<(), Failure> {
        let Some(book) = &mut self.book else { return Ok(()) };
        if let Some(loud) = book.enter(simulation, snapshot, course.clock()).await? {
            self.progress.say(&format!("warning: {loud}"));
            self.progress.event("remark", json!({ "text": loud }));
        }
        Ok(())
    }
}
