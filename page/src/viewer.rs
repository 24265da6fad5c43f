//! A scene that runs on a canvas.

use std::collections::VecDeque;
use std::sync::Arc;

use egui::Context;
use egui_winit::winit::dpi::PhysicalSize;
use egui_winit::winit::window::Window;
use motes::diagnose::{Judged, Remark};
use motes::gpu::{Choice, Controls, Found, Window as Surface};
use motes::scene::{Options, Scene, Source};
use motes::view::{Make, PICTURE, Taken, View};
use motes::{Energy, Error, Gpu, Simulation};

/// Particles that a page may hold: more than a field of WebGPU's default size has room for.
const MOST: u32 = 10_000_000;

/// A scene of the page.
pub struct Wanted {
    pub source: Source,
    /// Values in the form of `--set`.
    pub overrides: Vec<String>,
    /// A factor of the number of particles.
    pub scale: Option<f64>,
    /// Whether it stands still at first.
    pub paused: bool,
}

/// A canvas, and what runs on it.
pub struct Viewer {
    surface: Surface,
    found: Found,
    context: Context,
    size: PhysicalSize<u32>,
    view: Option<View<Gpu>>,
    /// The name of the scene that runs.
    name: String,
    taken: VecDeque<Taken>,
    /// The values that multiplied the particles of the scene, if a factor was given.
    scaled: Vec<String>,
    /// Files of bytes, for scenes that name them.
    held: Vec<(String, Vec<u8>)>,
    /// Scenes that the panel asks for are opened by the page's script, which knows the link.
    asked: Option<String>,
}

impl Viewer {
    /// Opens a device that can draw on a window.
    pub async fn open(window: Arc<Window>, context: Context) -> Result<Self, Error> {
        let size = window.inner_size();
        let (surface, found) = Surface::open(window, size.into(), &Choice::Best).await?;
        Ok(Self {
            surface,
            found,
            context,
            size,
            view: None,
            name: String::new(),
            taken: VecDeque::new(),
            scaled: Vec::new(),
            held: Vec::new(),
            asked: None,
        })
    }
    /// Holds a file, in the place of an earlier one of its name.
    pub fn hold(&mut self, name: String, bytes: Vec<u8>) {
        self.held.retain(|(known, _)| *known != name);
        self.held.push((name, bytes));
    }
    /// Opens a scene in the place of the present one, which goes on where there are faults. Returns remarks on it.
    pub async fn load(&mut self, wanted: &Wanted) -> Result<Vec<String>, String> {
        let options = Options { most_particles: MOST, ..Options::default() };
        let words = |error: Error| error.to_string();
        let source = match &wanted.source {
            Source::Memory { name, text, files } => {
                let held = self.held.iter().filter(|(name, _)| files.iter().all(|(known, _)| known != name));
                let files = files.iter().chain(held).cloned().collect();
                Source::Memory { name: name.clone(), text: text.clone(), files }
            }
            other => other.clone(),
        };
        let read =
            |overrides: &[String]| Scene::load(&source, overrides, &options).map_err(|faults| faults.to_string());
        let mut overrides = wanted.overrides.clone();
        let mut scene = read(&overrides)?;
        let scaled = wanted.scale.map(|factor| scene.scaled(factor)).transpose().map_err(words)?.unwrap_or_default();
        if !scaled.is_empty() {
            overrides.extend_from_slice(&scaled);
            scene = read(&overrides)?;
        }
        let setup = scene.setup().in_its_box().map_err(words)?.into_owned();
        let judged = Judged::of(&setup, scene.steps).await.map_err(words)?;
        scene.remarks.extend(judged.remarks.iter().map(Remark::to_string));
        let remarks = std::mem::take(&mut scene.remarks);
        let (device, queue) = (self.found.device.clone(), self.found.queue.clone());
        let make: Make<Gpu> = Box::new(move |setup| Simulation::new(&device, &queue, setup));
        let mut view = View::new(&scene, setup, make).await.map_err(words)?;
        view.pause(wanted.paused);
        self.found.faults.check().map_err(words)?;
        self.name.clone_from(&scene.name);
        self.scaled = scaled;
        let mut before = self.view.replace(view);
        self.end(&mut before).map_err(words)?;
        Ok(remarks)
    }
    /// Whether the run stands still.
    pub fn is_paused(&self) -> bool {
        self.view.as_ref().is_none_or(View::is_paused)
    }
    /// Whether nothing moves, so that no frame is due.
    pub fn rests(&self) -> bool {
        self.view.as_ref().is_none_or(View::rests)
    }
    /// The name of the scene, the step, and what is said.
    pub fn status(&mut self) -> (String, u64, String) {
        let view = self.view.as_mut().map(|view| (view.simulation().steps(), view.message().to_owned()));
        let (steps, said) = view.unwrap_or_default();
        (self.name.clone(), steps, said)
    }
    /// What was changed by hand, in the form of `--set`.
    pub fn changes(&self) -> Vec<String> {
        let changes = self.view.as_ref().map(View::changes).unwrap_or_default();
        if changes.is_empty() { changes } else { [&self.scaled[..], &changes].concat() }
    }
    /// The next picture or film that was taken, once.
    pub fn taken(&mut self) -> Option<Taken> {
        self.taken.pop_front()
    }
    /// No more frames are made: what was filmed is not lost.
    pub fn close(&mut self) -> Result<(), Error> {
        let mut view = self.view.take();
        let ended = self.end(&mut view);
        self.view = view;
        ended
    }
    fn end(&mut self, view: &mut Option<View<Gpu>>) -> Result<(), Error> {
        let Some(view) = view else { return Ok(()) };
        let ended = view.end();
        self.taken.extend(std::iter::from_fn(|| view.take()));
        ended
    }
    pub fn asked(&mut self) -> Option<String> {
        self.asked.take()
    }
    /// Runs so many steps, and measures the energies.
    pub async fn advance(&mut self, steps: u32) -> Result<Energy, Error> {
        let Some(view) = &mut self.view else { return Err(Error::Scene("no scene runs".to_owned())) };
        view.pause(true);
        view.step(steps).await?;
        self.found.faults.check()?;
        Energy::of(&view.simulation().snapshot().await?)
    }
    /// One frame: controls, steps, picture. Returns whether another is due soon.
    pub async fn frame(&mut self, input: egui::RawInput, size: PhysicalSize<u32>) -> Result<Frame, Error> {
        self.found.faults.check()?;
        if size != self.size {
            self.surface.resize(size.into())?;
            self.size = size;
        }
        let mut output = self.context.run_ui(input, |ui| {
            if let Some(view) = &mut self.view {
                view.controls(ui);
            }
        });
        let platform = std::mem::take(&mut output.platform_output);
        let soon = output.viewport_output.values().any(|viewport| viewport.repaint_delay.is_zero());
        let controls = Controls::of(&self.context, output);
        if let Some(view) = &mut self.view {
            view.advance().await?;
            self.asked = view.wanted().or(self.asked.take());
            self.taken.extend(std::iter::from_fn(|| view.take()));
            let size = view.size();
            if let Some(pixels) = view.simulation().buffer(PICTURE) {
                let id = self.surface.canvas().take(pixels, size)?;
                view.show(id);
            }
        }
        self.surface.paint(&controls)?;
        Ok(Frame { platform, soon })
    }
}

/// What a frame asks of the page.
pub struct Frame {
    /// The pointer's form, and text for the clipboard.
    pub platform: egui::PlatformOutput,
    /// Whether the controls are still moving.
    pub soon: bool,
}
