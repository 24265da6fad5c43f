//! `motes run --frames`: pictures evenly spaced over a run, and what joins them.

use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use glam::Vec4;
use motes::formats::apng;
use motes::kernel::Backend;
use motes::render::{self, Trail};
use motes::scene::Scene;
use motes::{Error, POSITION, Simulation, VELOCITY};
use serde_json::json;

use super::failure::Failure;
use super::output::Output;
use super::progress::Progress;

/// A state, until it is drawn.
struct Kept {
    step: u64,
    /// Pushes of the trail until then.
    pushes: u64,
    position: Vec<Vec4>,
    velocity: Vec<Vec4>,
}

/// The pictures of a run.
pub struct Film {
    frames: u64,
    /// The steps of the first and of the last frame.
    begun: u64,
    steps: u64,
    dt: f64,
    /// Frames in a second.
    rate: u16,
    folder: PathBuf,
    name: String,
    /// Whether the camera looks by itself.
    auto_frame: bool,
    reel: Option<render::Film>,
    /// States of a few particles, to be drawn when it is known where they go.
    kept: Vec<Kept>,
    done: Vec<PathBuf>,
    /// Particles out of the last frame.
    outside: u32,
}

impl Film {
    /// The film that a scene asks for; there may be none.
    pub fn of(scene: &Scene, begun: u64, folder: &Path, rate: u16) -> Option<Self> {
        (scene.output.frames > 0).then(|| Self {
            frames: scene.output.frames,
            begun,
            steps: scene.steps,
            dt: scene.dt,
            rate,
            folder: folder.to_owned(),
            name: scene.name.clone(),
            auto_frame: scene.picture.flag("auto_frame"),
            reel: None,
            kept: Vec::new(),
            done: Vec::new(),
            outside: 0,
        })
    }
    /// After how many steps the next frame is taken; `None` after the last.
    pub fn next(&self) -> Option<u64> {
        let taken = (self.done.len() + self.kept.len()) as u64;
        step(taken, self.frames, self.steps - self.begun).map(|step| self.begun + step)
    }
    /// Takes the next frame. The first one decides where the camera stands and what colours mean; a few particles, whose
    /// states are small, are only drawn in the end, by a camera that has all of their trails in view.
    pub async fn shoot<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        step: u64,
        output: &Output,
        progress: &Progress,
    ) -> Result<(), Failure> {
        if self.auto_frame && output.trail.wanted() {
            let (position, velocity) = (simulation.read(POSITION).await?, simulation.read(VELOCITY).await?);
            let pushes = output.trail.pushes();
            self.kept.push(Kept { step, pushes, position, velocity });
            return Ok(());
        }
        self.draw(simulation, output, output.trail.clone(), step, progress).await
    }
    /// Draws the states that are kept. The simulation is at its end: it is left with one of them.
    pub async fn develop<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        output: &Output,
        progress: &Progress,
    ) -> Result<(), Failure> {
        if !self.kept.is_empty() {
            self.begin(simulation, output, false).await?;
        }
        for Kept { step, pushes, position, velocity } in std::mem::take(&mut self.kept) {
            simulation.write(POSITION, &position)?;
            simulation.write(VELOCITY, &velocity)?;
            self.draw(simulation, output, output.trail.until(pushes), step, progress).await?;
        }
        Ok(())
    }
    async fn begin<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        output: &Output,
        room: bool,
    ) -> Result<(), Failure> {
        let picture = output.picture(&simulation.snapshot().await?)?;
        self.reel = Some(render::Film::new(picture, self.frames, room));
        let folder = self.folder.join("frames");
        let failed = |error: io::Error| Error::Output { file: folder.clone(), message: error.to_string() };
        Ok(std::fs::create_dir_all(&folder).map_err(failed)?)
    }
    async fn draw<B: Backend>(
        &mut self,
        simulation: &mut Simulation<B>,
        output: &Output,
        trail: Trail,
        step: u64,
        progress: &Progress,
    ) -> Result<(), Failure> {
        if self.reel.is_none() {
            self.begin(simulation, output, self.auto_frame).await?;
        }
        let Some(reel) = &mut self.reel else { return Ok(()) };
        reel.retrace(trail);
        let scenery = output.scenery.at(step as f64 * self.dt);
        reel.place(scenery.solids);
        reel.contain(scenery.tanks);
        let image = simulation.shoot(reel).await?;
        let name = format!("frames/frame_{:0w$}.png", self.done.len(), w = self.digits());
        let file = output.folder().file(&name)?;
        image.save(&file)?;
        progress.event("frame", json!({ "frame": self.done.len(), "step": step, "file": file }));
        self.done.push(file);
        self.outside = image.outside;
        Ok(())
    }
    /// Joins the frames that are there. Gives lines that say so.
    pub fn join(&self, progress: &Progress) -> Result<Vec<String>, Error> {
        let frames = self.done.len();
        if frames == 0 {
            return Ok(vec!["no film: the run was stopped before its first frame".to_owned()]);
        }
        let count = self.reel.as_ref().map_or(0, |film| film.picture().frame.count);
        if self.auto_frame && u64::from(self.outside) * 10 > u64::from(count) {
            progress.say(&format!(
                "note: {} of {count} particles have left the film, which is framed at its first picture: set \
                 picture.auto_frame = false with picture.center and picture.extent",
                self.outside
            ));
        }
        let film = format!("{}_film.png", self.name);
        apng::write_apng(&self.folder.join(&film), &self.done, self.rate)?;
        let rate = self.rate;
        progress.event("film", json!({ "file": self.folder.join(&film), "frames": frames, "fps": rate }));
        let line = format!("film: {film}, the {frames} pictures in frames/ at {rate} a second");
        Ok(vec![line, self.video(progress)])
    }
    /// A video, if ffmpeg is there; if not, or if it fails, a line says so.
    fn video(&self, progress: &Progress) -> String {
        let name = format!("{}_film.mp4", self.name);
        let part = format!("{}_film.part.mp4", self.name);
        let arguments = self.arguments(&format!("../{part}"));
        let mut command = Command::new("ffmpeg");
        command.current_dir(self.folder.join("frames")).args(["-loglevel", "error", "-nostdin", "-y"]);
        let made = command.args(&arguments).stdin(Stdio::null()).stdout(Stdio::null()).output();
        let reason = match made {
            Ok(done) if done.status.success() => {
                std::fs::rename(self.folder.join(&part), self.folder.join(&name)).err().map(|e| e.to_string())
            }
            Ok(done) => {
                let said = String::from_utf8_lossy(&done.stderr);
                let line = said.lines().rfind(|l| !l.trim().is_empty()).unwrap_or("it does not say why");
                Some(format!("ffmpeg failed ({}): {}", done.status, line.trim()))
            }
            Err(error) if error.kind() == io::ErrorKind::NotFound => Some("there is no ffmpeg on the PATH".to_owned()),
            Err(error) => Some(format!("ffmpeg does not start: {error}")),
        };
        let Some(reason) = reason else {
            let file = self.folder.join(&name);
            progress.event("video", json!({ "file": file, "frames": self.done.len(), "fps": self.rate }));
            return format!("video: {name}, made by ffmpeg");
        };
        // So that what ffmpeg has begun is not taken for a video.
        let _ = std::fs::remove_file(self.folder.join(&part));
        let words = self.arguments(&format!("../{name}"));
        let by_hand = words.iter().fold("ffmpeg".to_owned(), |line, word| line + " " + &quoted(word));
        progress.event("video", json!({ "file": null, "reason": reason, "command": by_hand }));
        let place = self.folder.join("frames");
        format!("no video: {reason}; to make one, in {}: {by_hand}", place.display())
    }
    /// H.264 as every player knows it, which wants sides that are even. Earlier runs may have left more frames.
    fn arguments(&self, to: &str) -> Vec<String> {
        let (rate, frames) = (self.rate.to_string(), self.done.len().to_string());
        let files = format!("frame_%0{}d.png", self.digits());
        let even = "crop=trunc(iw/2)*2:trunc(ih/2)*2";
        let words = ["-framerate", &rate, "-i", &files, "-frames:v", &frames, "-vf", even, "-c:v", "libx264"];
        let more = ["-crf", "18", "-pix_fmt", "yuv420p", "-movflags", "+faststart", to];
        words.into_iter().chain(more).map(str::to_owned).collect()
    }
    /// Digits of the numbers of frames.
    fn digits(&self) -> usize {
        (self.frames - 1).to_string().len().max(4)
    }
}

/// A word for a shell.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./%+:".contains(c);
    if word.chars().all(plain) { word.to_owned() } else { format!("'{}'", word.replace('\'', "'\\''")) }
}

/// After how many steps frame `k` of `frames` is taken: the first before any, the last after all, and an only one too.
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
