//! Checkpoints and continuation: checkpoints are written, the newest intact one is found, and results are truncated to it.

use std::io::Write as _;
use std::path::PathBuf;
use std::sync::Arc;

use web_time::Instant;

use super::Folder;
use super::checkpoint::{self, Checkpoint, Past, Place, Unread};
use super::course::Course;
use super::film::Film;
use super::progress::Progress;
use super::table::{self, Lengths};
use super::{Options, Run};
use crate::error::Error;
use crate::formats::atomically;
use crate::kernel::Backend;
use crate::render::Trail;
use crate::scene::{Scene, Source};
use crate::simulation::{Setup, Simulation};
use crate::state::State;

/// The start of the last line of the resolved scene of a completed run.
const COMPLETE: &str = "# Complete at step ";

/// The results that a run which continues finds in its folder.
#[derive(Debug)]
pub enum Found {
    /// No results.
    Nothing,
    /// Results of a run that was ended before its first checkpoint.
    Begun,
    /// All results of a run, which ended at this step.
    Complete(u64),
    /// The newest intact checkpoint, and the errors of newer ones.
    Checkpoint(Box<Checkpoint>, Vec<Error>),
}

impl Found {
    /// Examines a locked folder.
    ///
    /// # Errors
    /// [`Error::Input`] when there are checkpoints, and all are damaged, or one cannot be read for a reason other than damage.
    pub fn of(folder: &Folder) -> Result<Self, Error> {
        let text = std::fs::read_to_string(folder.path().join("scene.toml")).unwrap_or_default();
        if let Some(step) = complete(&text) {
            // Left by a run that was killed just after it was marked as complete.
            folder.keep_checkpoints(0, u64::MAX)?;
            return Ok(Self::Complete(step));
        }
        let mut damaged = Vec::new();
        for file in folder.checkpoints()? {
            match Checkpoint::examine(&file) {
                Ok(found) => return Ok(Self::Checkpoint(Box::new(found), damaged)),
                Err(error @ Unread::Damaged(_)) => damaged.push(error.of(&file)),
                Err(error) => return Err(error.of(&file)),
            }
        }
        match damaged.into_iter().next() {
            Some(Error::Input { file, message }) => Err(Error::Input {
                file,
                message: format!("{message}; no checkpoint in the folder is intact: start over with --overwrite"),
            }),
            Some(other) => Err(other),
            None if text.is_empty() => Ok(Self::Nothing),
            None => Ok(Self::Begun),
        }
    }
}

/// The step at which a run is complete, by the line after the signature in its resolved scene. A scene's own comments are before both.
fn complete(text: &str) -> Option<u64> {
    let mut lines = text.lines().rev();
    let step = lines.next()?.strip_prefix(COMPLETE)?.parse().ok()?;
    lines.next()?.starts_with(Folder::SIGNATURE).then_some(step)
}

/// The scene that was signed when the run began.
fn signed(folder: &Folder) -> Option<String> {
    let text = std::fs::read_to_string(folder.path().join("scene.toml")).ok()?;
    let (scene, signature) = text.rsplit_once(&format!("\n{}", Folder::SIGNATURE))?;
    (signature.lines().count() == 1).then(|| scene.to_owned())
}

/// Whether the results in a folder are those of this scene.
#[must_use]
pub fn is_of(folder: &Folder, scene: &Scene) -> bool {
    let text = std::fs::read_to_string(folder.path().join("scene.toml")).unwrap_or_default();
    text.starts_with(&format!("{}\n{}", scene.resolved_in(folder.path()), Folder::SIGNATURE))
}

impl Checkpoint {
    /// The source of its scene, for [`Scene::load`].
    #[must_use]
    pub fn source(&self) -> Source {
        Source::Text {
            name: format!("{}.toml", self.name()),
            text: self.scene().to_owned(),
            folder: self.folder().to_owned(),
        }
    }
    /// The options with which its run was started, with results in this folder.
    #[must_use]
    pub fn options(&self, output: impl Into<PathBuf>) -> Options {
        let also: toml::Table = self.packed.also.parse().unwrap_or_default();
        let fps = also.get("fps").and_then(toml::Value::as_integer).and_then(|fps| u16::try_from(fps).ok());
        let ledger = also.get("ledger").and_then(toml::Value::as_bool).unwrap_or(false);
        Options { ledger, fps: fps.unwrap_or(30), from: self.from(), ..Options::into(output) }
    }
}

impl Run {
    /// A run that continues from a checkpoint in the folder, which stays locked; `setup` gets its state. Scene and options must be those
    /// with which it was begun, as [`Checkpoint::source`] and [`Checkpoint::options`] return them.
    ///
    /// # Errors
    /// [`Error::Scene`] when the scene differs, [`Error::Input`] when the checkpoint does not fit it.
    pub fn resume(
        scene: Scene,
        setup: &mut Setup,
        options: Options,
        (folder, from): (Folder, Checkpoint),
    ) -> Result<Self, Error> {
        let folder = folder.named(&scene.name);
        let mut run = Self::of(scene, setup, options, Some(Arc::new(folder)))?;
        if let Some(what) = run.packed.difference(&from.packed) {
            return Err(Error::Scene(format!(
                "the checkpoint {} is of another scene: {what}; `motes resume` goes on with the scene of the checkpoint, --overwrite \
                 begins anew",
                from.file().display()
            )));
        }
        let state = from.state(&run.columns)?;
        let unfit =
            |error: Error| Error::Input { file: from.file().to_owned(), message: format!("cannot go on: {error}") };
        run.fits(&from, &state)?;
        setup.state.go_on_from(&state).map_err(unfit)?;
        run.begun = from.past.begun;
        run.film = Film::of(&run.scene, run.begun, run.options.fps, &run.stream);
        if let (Some(film), Some(folder)) = (&run.film, &run.folder) {
            film.there(from.past.film.done, folder)?;
        }
        run.resumed = Some(from);
        Ok(run)
    }
    /// Compares a checkpoint with its state, the scene and the folder, before anything is truncated to it.
    fn fits(&self, from: &Checkpoint, state: &State) -> Result<(), Error> {
        let (past, reel, (step, time)) = (&from.past, &from.past.film, from.at());
        let refuse = |what: String| {
            let message = format!("does not fit: {what}; begin anew with --overwrite");
            Err(Error::Input { file: from.file().to_owned(), message })
        };
        if (state.step, state.time.to_bits()) != (step, time.to_bits()) {
            return refuse(format!(
                "it has step {step} and time {time}, and its state {} and {}",
                state.step, state.time
            ));
        }
        let last = self.scene.steps;
        if past.begun > past.done || past.done >= last {
            return refuse(format!("{} steps are done since step {}, of {last}", past.done, past.begun));
        }
        if self.scene.adaptive_step.is_none() && past.done != step {
            return refuse(format!("{} steps are done at step {step}", past.done));
        }
        if self.pictures.trail.wanted() && Trail::of(self.count, &past.trail).is_none() {
            return refuse(format!("{} numbers are no trail of {} particles", past.trail.len(), self.count));
        }
        let (frames, kept) = (self.scene.output.frames, reel.steps.len() as u64 / 2);
        let pairs = reel.steps.len().is_multiple_of(2) && reel.numbers.len() as u64 == kept * 8 * self.count as u64;
        if !pairs || reel.done.saturating_add(kept) > frames || u32::try_from(reel.outside).is_err() {
            return refuse(format!("{} pictures and {kept} states are no part of a film of {frames}", reel.done));
        }
        if let Some(folder) = &self.folder {
            past.lengths.iter().try_for_each(|(name, length)| table::holds(&folder.file(name)?, *length).map(drop))?;
        }
        Ok(())
    }
    /// The program and the machine of this run.
    fn place(&self) -> Place {
        let version = env!("CARGO_PKG_VERSION").to_owned();
        Place { version, device: self.options.device.clone(), precision: self.options.precision }
    }
    /// The differences in version and device since the checkpoint was written.
    fn moved(&self, from: &Checkpoint) -> Option<String> {
        let (was, is) = (&from.place, self.place());
        let pairs = [("version", &was.version, &is.version), ("device", &was.device, &is.device)];
        let other = |(what, was, is): (&str, &String, &String)| {
            (was != is).then(|| format!("the {what} is {is}, and was {was}"))
        };
        let words: Vec<_> = pairs.into_iter().filter_map(other).collect();
        (!words.is_empty())
            .then(|| format!("{}: bits may be others than those of a run that was never stopped", words.join("; ")))
    }
    /// Opens folder and tables. Where the run continues, they are truncated to the checkpoint.
    pub(super) fn open(&mut self, progress: &mut dyn Progress) -> Result<Arc<Folder>, Error> {
        let folder = if let Some(folder) = self.folder.take() {
            folder
        } else {
            let (path, overwrite) = (&self.options.output, self.options.overwrite);
            Arc::new(Folder::open(path, &self.scene.name, &self.scene.files, overwrite)?)
        };
        self.folder = Some(folder.clone());
        if let Some(text) = folder.remark() {
            progress.remark(text);
        }
        let from = self.resumed.take();
        if from.is_none() {
            self.sign(&folder, None)?;
        }
        let none = Lengths::new();
        let lengths = from.as_ref().map_or(&none, |from| &from.past.lengths);
        self.measures.iter_mut().try_for_each(|one| one.open(&folder, lengths))?;
        for writer in self.all() {
            writer.open(&folder, lengths)?;
        }
        if let Some(from) = from {
            self.go_on(&from, &folder, progress)?;
            // The folder of its files is deleted with it.
            self.goes_on = Some(from.past.done);
        }
        Ok(folder)
    }
    /// Restores the host's data of the run.
    fn go_on(&mut self, from: &Checkpoint, folder: &Arc<Folder>, progress: &mut dyn Progress) -> Result<(), Error> {
        let past = &from.past;
        let gone = folder.keep_only(&past.results)?;
        if gone > 0 {
            progress.remark(&format!("{gone} results behind the checkpoint are removed, and will be written again"));
        }
        let looks = &mut self.looks;
        (looks.kinetic, looks.change, looks.count) = (past.kinetic, past.change, past.looks);
        if let Some(trail) = Trail::of(self.count, &past.trail).filter(|_| self.pictures.trail.wanted()) {
            self.pictures.trail = trail;
        }
        if let Some(film) = &mut self.film {
            film.resume(from, self.count, &self.columns, (&self.pictures, folder))?;
        }
        progress.remark(&format!("resumes from {}", from.file().display()));
        if let Some(text) = self.moved(from) {
            progress.remark(&text);
        }
        Ok(())
    }
    /// Writes the scene with every value, by which a later run recognises the results of this one, and whether it is complete. Where the
    /// run was continued, it is the scene that was signed first: the files that it names exist, and those of the checkpoint do not.
    pub(super) fn sign(&self, folder: &Folder, complete: Option<u64>) -> Result<(), Error> {
        let first = self.goes_on.and_then(|_| signed(folder));
        let scene = first.unwrap_or_else(|| self.scene.resolved_in(folder.path()));
        let signature = folder.signature(&self.options.device);
        let end = complete.map_or_else(String::new, |step| format!("{COMPLETE}{step}\n"));
        atomically(&folder.file("scene.toml")?, |out| write!(out, "{scene}\n{signature}{end}"))
    }
    /// Writes a checkpoint of the present state, and removes those that are too old to be kept.
    pub(super) async fn save<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        course: &Course,
        progress: &mut dyn Progress,
    ) -> Result<(), Error> {
        let Some(folder) = self.folder.clone() else { return Ok(()) };
        let begun = Instant::now();
        let state = simulation.snapshot().await?;
        // All results that it lists exist, and rows that it counts are on the disk.
        self.stream.drain()?;
        let mut lengths = Lengths::new();
        for table in self.tables() {
            table.settle()?;
            lengths.insert(table.name().to_owned(), table.length());
        }
        let past = Past {
            begun: self.begun,
            done: course.done(),
            lengths,
            results: folder.results()?,
            kinetic: self.looks.kinetic,
            change: self.looks.change,
            looks: self.looks.count,
            trail: self.pictures.trail.numbers(),
            film: self.film.as_ref().map(Film::kept).unwrap_or_default(),
        };
        let file = folder.checkpoint(state.step)?;
        checkpoint::write(&file, &self.scene.name, (&state, &self.place()), &self.packed, &past)?;
        folder.keep_checkpoints(self.scene.checkpoint.keep, state.step)?;
        self.schedule.written(simulation.steps(), course.time(), begun);
        progress.checkpoint(state.step, &file);
        self.last = Some(Arc::new(state));
        Ok(())
    }
}
