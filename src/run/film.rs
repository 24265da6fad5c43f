//! Pictures evenly spaced over a run, joined to a film.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use glam::Vec4;

use super::Folder;
use super::checkpoint::{Checkpoint, Reel};
use super::images;
use super::pictures::Pictures;
use super::progress::Progress;
use super::stream::Stream;
use crate::error::Error;
use crate::kernel::{Backend, Bounds, Columns, POSITION, VELOCITY};
use crate::render::{self, Trail};
use crate::scene::Scene;
use crate::simulation::Simulation;
use crate::state::State;

/// A state that is not drawn yet.
#[derive(Debug)]
struct Kept {
    step: u64,
    /// The number of pushes to the trail at that time.
    pushes: u64,
    position: Vec<Vec4>,
    velocity: Vec<Vec4>,
}

/// The pictures of a film.
#[derive(Debug)]
pub struct Film {
    frames: u64,
    /// The steps of the first and of the last frame.
    begun: u64,
    steps: u64,
    dt: f64,
    rate: u16,
    name: String,
    /// Whether the camera is set up automatically.
    auto_frame: bool,
    reel: Option<render::Film>,
    /// The state for which the camera was set up, and the number of pushes to the trail at that time.
    first: Option<(State, u64)>,
    /// States of runs with few particles, drawn at the end when their extent is known.
    kept: Vec<Kept>,
    done: Vec<PathBuf>,
    /// The number of particles outside the last frame.
    outside: u32,
    stream: Stream,
}

impl Film {
    /// The film of a scene, if it has one.
    pub(super) fn of(scene: &Scene, begun: u64, rate: u16, stream: &Stream) -> Option<Self> {
        (scene.output.frames > 0).then(|| Self {
            frames: scene.output.frames,
            begun,
            steps: scene.steps,
            dt: scene.dt,
            rate,
            name: scene.name.clone(),
            auto_frame: scene.picture.flag("auto_frame"),
            reel: None,
            first: None,
            kept: Vec::new(),
            done: Vec::new(),
            outside: 0,
            stream: stream.clone(),
        })
    }
    /// The frames that are written.
    #[must_use]
    pub fn done(&self) -> &[PathBuf] {
        &self.done
    }
    /// Frames per second.
    #[must_use]
    pub fn rate(&self) -> u16 {
        self.rate
    }
    /// The number of particles outside the last frame, and of all, where the camera was set up automatically.
    #[must_use]
    pub fn outside(&self) -> Option<(u32, u32)> {
        let count = self.reel.as_ref()?.picture().frame.count;
        self.auto_frame.then_some((self.outside, count))
    }
    /// The number of digits in the numbers of frames.
    #[must_use]
    pub fn digits(&self) -> usize {
        (self.frames - 1).to_string().len().max(4)
    }
    /// The file that joins the frames, in the folder of the run.
    #[must_use]
    pub fn file(&self) -> String {
        format!("{}_film.png", self.name)
    }
    /// The step of the next frame; `None` after the last.
    pub(super) fn next(&self) -> Option<u64> {
        let taken = (self.done.len() + self.kept.len()) as u64;
        step(taken, self.frames, self.steps - self.begun).map(|step| self.begun + step)
    }
    /// Takes the next frame. The first one determines the camera and the colour scale; runs with few particles, whose states are small, are
    /// drawn only at the end, by a camera that shows all of their trails.
    pub(super) async fn shoot<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        step: u64,
        to: (&Pictures, &Arc<Folder>),
        progress: &mut dyn Progress,
    ) -> Result<(), Error> {
        let trail = &to.0.trail;
        // Of columns nothing is kept.
        if self.auto_frame && trail.wanted() && !to.0.shows_column() {
            let (position, velocity) = (simulation.read(POSITION).await?, simulation.read(VELOCITY).await?);
            self.kept.push(Kept { step, pushes: trail.pushes(), position, velocity });
            return Ok(());
        }
        let bounds = simulation.bounds().await?;
        self.draw(simulation, (to, bounds), trail.clone(), step, progress).await
    }
    /// Draws the stored states. The simulation is at its end, and is left with one of them.
    pub(super) async fn develop<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        to: (&Pictures, &Arc<Folder>),
        progress: &mut dyn Progress,
    ) -> Result<(), Error> {
        if !self.kept.is_empty() {
            let state = simulation.snapshot().await?;
            self.begin((state, to.0.trail.pushes()), to, false)?;
        }
        // Trails pass through all times, and so are drawn in the box of the end.
        let bounds = simulation.bounds().await?;
        for Kept { step, pushes, position, velocity } in std::mem::take(&mut self.kept) {
            simulation.write(POSITION, &position)?;
            simulation.write(VELOCITY, &velocity)?;
            self.draw(simulation, (to, bounds), to.0.trail.until(pushes), step, progress).await?;
        }
        Ok(())
    }
    /// Sets up the camera for a state.
    fn begin(
        &mut self,
        first: (State, u64),
        (pictures, folder): (&Pictures, &Arc<Folder>),
        room: bool,
    ) -> Result<(), Error> {
        let picture = pictures.of(&first.0, pictures.trail.until(first.1))?;
        self.reel = Some(render::Film::new(picture, self.frames, room));
        self.first = Some(first);
        let folder = folder.path().join("frames");
        std::fs::create_dir_all(&folder).map_err(|error| Error::Output { file: folder, message: error.to_string() })
    }
    async fn draw<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        (to, bounds): ((&Pictures, &Arc<Folder>), Bounds),
        trail: Trail,
        step: u64,
        progress: &mut dyn Progress,
    ) -> Result<(), Error> {
        if self.reel.is_none() {
            let state = simulation.snapshot().await?;
            self.begin((state, to.0.trail.pushes()), to, self.auto_frame)?;
        }
        let file = to.1.file(&self.frame(self.done.len()))?;
        let Some(reel) = &mut self.reel else { return Ok(()) };
        reel.retrace(trail);
        let time = step as f64 * self.dt;
        let scenery = to.0.scenery(&bounds, time);
        reel.place(scenery.solids);
        reel.contain(scenery.tanks);
        let image = simulation.shoot(reel).await?;
        let image = Arc::new(images::note(image, reel.picture(), time));
        images::save_later(&image, file.clone(), to.1, &self.stream)?;
        progress.frame(self.done.len(), step, &file);
        self.done.push(file);
        self.outside = image.outside;
        Ok(())
    }
    /// The file of a frame, in the folder of the run.
    fn frame(&self, number: usize) -> String {
        format!("frames/frame_{number:0w$}.png", w = self.digits())
    }
    /// Joins the frames that are written, if any.
    pub(super) fn join(&self, folder: &Folder) -> Result<(), Error> {
        if self.done.is_empty() {
            return Ok(());
        }
        self.stream.drain()?;
        images::join(&folder.file(&self.file())?, &self.done, self.rate)
    }
    /// The first `done` frames, which must exist.
    ///
    /// # Errors
    /// [`Error::Output`] with the first one that is missing.
    pub(super) fn there(&self, done: u64, folder: &Folder) -> Result<Vec<PathBuf>, Error> {
        let one = |number| {
            let file = folder.file(&self.frame(number))?;
            if file.is_file() {
                return Ok(file);
            }
            let message =
                "the film continues after this picture, which is missing: restore it, or start over with --overwrite";
            Err(Error::Output { file, message: message.to_owned() })
        };
        (0..usize::try_from(done).unwrap_or(usize::MAX)).map(one).collect()
    }
    /// The data of the film in a checkpoint.
    pub(super) fn kept(&self) -> Reel {
        let four = |all: &[Vec4]| all.iter().flat_map(Vec4::to_array).collect::<Vec<f32>>();
        let numbers = self.kept.iter().flat_map(|kept| [four(&kept.position), four(&kept.velocity)].concat());
        Reel {
            done: self.done.len() as u64,
            outside: self.outside.into(),
            exposure: self.reel.as_ref().and_then(render::Film::exposure),
            scale: self.reel.as_ref().and_then(render::Film::scale),
            first: self.first.as_ref().map(|(state, _)| state.clone()),
            life: self.first.as_ref().is_some_and(|(state, _)| !state.life().is_empty()),
            pushes: self.first.as_ref().map_or(0, |(_, pushes)| *pushes),
            steps: self.kept.iter().flat_map(|kept| [kept.step, kept.pushes]).collect(),
            numbers: numbers.collect(),
        }
    }
    /// Continues from a checkpoint with `count` particles.
    ///
    /// # Errors
    /// [`Error::Output`] when a frame is no longer there, [`Error::Input`] when the checkpoint does not fit.
    pub(super) fn resume(
        &mut self,
        from: &Checkpoint,
        count: usize,
        columns: &Columns,
        to: (&Pictures, &Arc<Folder>),
    ) -> Result<(), Error> {
        let reel = &from.past.film;
        self.done = self.there(reel.done, to.1)?;
        self.outside = u32::try_from(reel.outside).unwrap_or(u32::MAX);
        if let Some(state) = from.film(columns)? {
            self.begin((state, reel.pushes), (to.0, to.1), self.auto_frame)?;
        }
        if let Some(film) = &mut self.reel {
            film.go_on(reel.exposure, reel.scale);
        }
        if reel.numbers.len() != reel.steps.len() / 2 * 8 * count {
            let message = "is damaged: states of the film are missing".to_owned();
            return Err(Error::Input { file: Path::to_owned(from.file()), message });
        }
        let four = |numbers: &[f32]| numbers.chunks_exact(4).map(Vec4::from_slice).collect::<Vec<_>>();
        for (pair, numbers) in reel.steps.chunks_exact(2).zip(reel.numbers.chunks_exact((8 * count).max(1))) {
            let (position, velocity) = (four(&numbers[..4 * count]), four(&numbers[4 * count..]));
            self.kept.push(Kept { step: pair[0], pushes: pair[1], position, velocity });
        }
        Ok(())
    }
}

/// The step of frame `k` of `frames`: the first one before any step, the last one after all, and a single one too.
fn step(k: u64, frames: u64, steps: u64) -> Option<u64> {
    if k >= frames {
        return None;
    }
    if frames == 1 {
        return Some(steps);
    }
    // Both are below 2³³, so their product needs more than 64 bits.
    let (k, last, steps) = (u128::from(k), u128::from(frames - 1), u128::from(steps));
    u64::try_from((2 * k * steps + last) / (2 * last)).ok()
}

#[cfg(test)]
mod tests {
    use super::step;

    #[test]
    fn frames_are_evenly_spaced_from_the_first_state_to_the_last() {
        let all = |frames, steps| (0..).map_while(|k| step(k, frames, steps)).collect::<Vec<_>>();
        assert_eq!(all(1, 100), [100]);
        assert_eq!(all(2, 100), [0, 100]);
        // Thirds of a hundred, to the nearest whole number; and halves upwards.
        assert_eq!(all(4, 100), [0, 33, 67, 100]);
        assert_eq!(all(3, 3), [0, 2, 3]);
        assert_eq!(all(6, 5), [0, 1, 2, 3, 4, 5]);
        let steps = u64::from(u32::MAX);
        assert_eq!(step(steps - 1, steps, steps), Some(steps));
        for (frames, steps) in [(240, 1000), (241, 240), (97, 1013)] {
            let all = all(frames, steps);
            assert_eq!((all.len() as u64, all[0], all[all.len() - 1]), (frames, 0, steps));
            assert!(all.windows(2).all(|w| w[0] < w[1] && w[1] - w[0] <= steps / (frames - 1) + 1), "{all:?}");
        }
    }
}
