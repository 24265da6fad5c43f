//! A simulation that one watches and changes while it runs. It knows no window: a shell gives it input, and paints what it makes.

mod action;
mod added;
mod changes;
mod chosen;
mod controls;
mod due;
pub mod gallery;
mod keyboard;
mod legend;
mod notes;
mod orbit;
mod pace;
mod plots;
mod recording;
mod seldom;
mod sliders;
mod stage;
mod tool;

use std::collections::VecDeque;

use egui::{TextureId, Ui};
use glam::DVec3;
use web_time::Instant;

use crate::error::Error;
use crate::kernel::{Array, Backend, Element as _, Field};
use crate::render::{Camera, Image, PIXELS};
use crate::scene::Scene;
use crate::simulation::{Setup, Simulation};
use action::Action;
use chosen::Chosen;
use pace::Pace;
use plots::Plots;
use recording::Recording;
use stage::Stage;
use tool::{Hand, Tool};

/// Makes a simulation of a setup on the shell's device.
pub type Make<B> = Box<dyn Fn(&Setup) -> Result<Simulation<B>, Error>>;

/// Makes a text for the clipboard of what was changed by hand, in the form of `--set`.
pub type Command = Box<dyn Fn(&[String]) -> String>;

/// The field with the pixels of the picture.
pub const PICTURE: Field<u32> = PIXELS;

/// What a pull of a run that stands still says.
const STILL: &str = "nothing is pulled while the run stands still: Space goes on";

/// A picture or a film that was taken, and the name of its file.
pub struct Taken {
    /// A PNG, which is animated if it is a film.
    pub png: Vec<u8>,
    /// A name made of the scene and the step.
    pub name: String,
}

/// A running simulation, its picture and its controls.
pub struct View<B: Backend> {
    stage: Stage<B>,
    pace: Pace,
    plots: Plots,
    chosen: Option<Chosen>,
    hand: Hand,
    paused: bool,
    /// Whether the panel is shown, and the list of keys.
    panel: bool,
    help: bool,
    /// The texture of the contact sheet, if the shell has one, and whether the scenes are shown.
    contact: Option<TextureId>,
    scenes: bool,
    /// What was asked for since the last frame.
    actions: Vec<Action>,
    /// The pixels of the picture's place, and its texture.
    size: [u32; 2],
    texture: Option<TextureId>,
    /// What is said below the picture.
    message: String,
    /// The fault that has stopped the run.
    fault: Option<String>,
    taken: VecDeque<Taken>,
    recording: Option<Recording>,
    /// The command of a scene with changes, and a text for the clipboard.
    command: Command,
    copied: Option<String>,
    /// The scene that the shell is asked to open.
    wanted: Option<String>,
    /// Whether the state is still that of the picture.
    drawn: bool,
    /// The picture that could not be drawn last: another one of the same state could not be, either.
    undrawn: Option<([u32; 2], bool)>,
    /// The step that was measured last, if forces and the measures that are looked at are as they were.
    measured: Option<u64>,
    /// Whether the last frame did nothing that its controls, which come first, have not shown.
    shown: bool,
}

impl<B: Backend> View<B> {
    /// A view of a scene with its setup.
    ///
    /// # Errors
    /// When the setup is invalid, a shader does not compile, or the fields do not fit the device.
    pub async fn new(scene: &Scene, setup: Setup, make: Make<B>) -> Result<Self, Error> {
        let plots = Plots::new(&setup, &scene.measures)?;
        let stage = Stage::new(scene, setup, make).await?;
        Ok(Self {
            pace: Pace::new(stage.dt()),
            stage,
            plots,
            chosen: None,
            hand: Hand::default(),
            paused: false,
            panel: true,
            help: false,
            contact: None,
            scenes: false,
            actions: Vec::new(),
            size: [640, 384],
            texture: None,
            message: String::new(),
            fault: None,
            taken: VecDeque::new(),
            recording: None,
            command: Box::new(|changes| changes.join("\n")),
            copied: None,
            wanted: None,
            drawn: false,
            undrawn: None,
            measured: None,
            shown: false,
        })
    }
    /// The simulation. Its field [`PICTURE`] holds the last picture. What is written to it while the run stands still is drawn after the next input.
    pub fn simulation(&mut self) -> &mut Simulation<B> {
        &mut self.stage.simulation
    }
    /// The pixels of the last picture, from left to right and from top to bottom.
    #[must_use]
    pub fn size(&self) -> [u32; 2] {
        let frame = &self.stage.picture().frame;
        [frame.width, frame.height]
    }
    /// Reads the last picture: red, green, blue and alpha of each pixel, row by row from the top. A shell needs no copy.
    ///
    /// # Errors
    /// When the device is lost, out of memory or does not answer in time.
    pub async fn pixels(&mut self) -> Result<Vec<u8>, Error> {
        let area = self.size().map(|side| side as usize).iter().product();
        let words = self.stage.simulation.backend().read(PICTURE.name, &Array::Uint(Vec::new()), area).await?;
        Ok(u32::view(&words).into_iter().flatten().flat_map(|word| word.to_le_bytes()).collect())
    }
    /// What is copied of changes by hand: the command that opens this scene with them. Without this it is a list of them.
    pub fn opened_by(&mut self, command: Command) {
        self.command = command;
    }
    /// Shows pictures of the scenes that come with motes, from a [contact sheet](gallery).
    pub fn contact(&mut self, sheet: TextureId) {
        self.contact = Some(sheet);
    }
    /// Shows the last picture under this name from now on.
    pub fn show(&mut self, texture: TextureId) {
        self.texture = Some(texture);
    }
    /// Makes so many steps in every frame, however long they take.
    pub fn each_frame(&mut self, steps: u32) {
        self.pace.fixed = Some(steps);
    }
    /// Pauses the run, or goes on.
    pub fn pause(&mut self, paused: bool) {
        self.paused = paused || self.fault.is_some();
        if !self.paused && self.message == STILL {
            self.message.clear();
        }
    }
    /// The mean times of a step and of a picture \[seconds\], once there was one.
    #[must_use]
    pub fn times(&self) -> [Option<f64>; 2] {
        [self.pace.step, self.pace.picture]
    }
    /// Whether the run stands still.
    #[must_use]
    pub fn is_paused(&self) -> bool {
        self.paused
    }
    /// What is said to the user, if anything: what was said last, or else why the run has stopped.
    #[must_use]
    pub fn message(&self) -> &str {
        match &self.fault {
            Some(fault) if self.message.is_empty() => fault,
            _ => &self.message,
        }
    }
    /// Goes on as a view of the same scene before it was read again: paused or not, as fast, from where it was seen, with the same tool.
    pub fn follow(&mut self, before: &Self) {
        self.paused = before.paused && before.fault.is_none();
        self.pace.wanted = before.pace.wanted;
        self.hand.tool = before.hand.tool;
        (self.hand.reach, self.hand.strength) = (before.hand.reach, before.hand.strength);
        (self.panel, self.help, self.size) = (before.panel, before.help, before.size);
        if before.stage.moved() {
            let camera = before.stage.picture().frame.camera;
            self.stage.camera(|_| camera);
        }
    }
    /// The next picture or film that was asked for, once.
    pub fn take(&mut self) -> Option<Taken> {
        self.taken.pop_front()
    }
    /// What was changed by hand in forces, picture and camera, as `--set` and links take it: `force.0.softening=0.1`.
    #[must_use]
    pub fn changes(&self) -> Vec<String> {
        self.stage.changes()
    }
    /// The scene that is to be opened, once.
    pub fn wanted(&mut self) -> Option<String> {
        self.wanted.take()
    }
    /// Says something.
    pub fn say(&mut self, text: impl Into<String>) {
        (self.message, self.shown) = (text.into(), false);
    }
    /// The id of the particle that was chosen, and where it is, if one was.
    #[must_use]
    pub fn chosen(&self) -> Option<(u32, Option<DVec3>)> {
        self.chosen.as_ref().map(|chosen| (chosen.id, chosen.position))
    }
    /// The controls and the picture, and what the user asks for.
    pub fn controls(&mut self, ui: &mut Ui) {
        keyboard::read(ui.ctx(), self.hand.tool, &mut self.actions);
        controls::show(self, ui);
    }
    /// Does what was asked for, advances, and draws. A fault of the run stops it and is said.
    ///
    /// # Errors
    /// When the device is lost, out of memory or does not answer in time.
    pub async fn advance(&mut self) -> Result<(), Error> {
        self.shown = true;
        for action in std::mem::take(&mut self.actions) {
            self.changed();
            if let Err(error) = self.act(action).await {
                self.refuse(error)?;
            }
        }
        if !self.paused {
            let steps = self.pace.steps();
            if let Err(error) = self.step(steps).await {
                let said = std::mem::take(&mut self.message);
                self.refuse(error)?;
                self.paused = true;
                self.fault = Some(std::mem::replace(&mut self.message, said));
            }
        }
        if self.paused
            && self.measures_lack()
            && let Err(error) = self.measure().await
        {
            self.refuse(error)?;
        }
        if let Err(error) = self.find().await {
            self.refuse(error)?;
        }
        self.draw().await?;
        if let Err(error) = self.record().await {
            self.refuse(error)?;
        }
        Ok(())
    }
    /// Finds the chosen particle again, and goes with it.
    async fn find(&mut self) -> Result<(), Error> {
        let Some(chosen) = &mut self.chosen else { return Ok(()) };
        let time = self.stage.time();
        if !chosen.update(&mut self.stage.simulation, time, self.paused).await? {
            let id = chosen.id;
            self.chosen = None;
            self.say(format!("particle {id} has left the simulation"));
            return Ok(());
        }
        if let (true, Some(center)) = (chosen.follow, chosen.position) {
            self.stage.camera(|camera| Camera { center, ..camera });
        }
        Ok(())
    }
    /// Adds the picture to the film, if there is one.
    async fn record(&mut self) -> Result<(), Error> {
        let step = self.stage.simulation.steps();
        if !self.recording.as_ref().is_some_and(|recording| recording.wants(step)) {
            return Ok(());
        }
        let ([width, height], rgba) = (self.size(), self.pixels().await?);
        let mut image = Image { width, height, rgba, outside: 0, broken: 0 };
        self.stage.annotate(&mut image);
        let Some(recording) = &mut self.recording else { return Ok(()) };
        let room = recording.add(step, &image)?;
        self.message = recording.words();
        if !room {
            self.end_recording()?;
            self.say("the film is as long as memory allows, and is saved");
        }
        Ok(())
    }
    /// When the view ends: the film that is being recorded becomes one that [is taken](Self::take).
    ///
    /// # Errors
    /// When the film cannot be made.
    pub fn end(&mut self) -> Result<(), Error> {
        self.end_recording()
    }
    /// The film becomes a file.
    fn end_recording(&mut self) -> Result<(), Error> {
        let Some(recording) = self.recording.take() else { return Ok(()) };
        self.message.clear();
        if recording.is_empty() {
            return Ok(());
        }
        let name = format!("{}_{:06}_film.png", self.stage.name, self.stage.simulation.steps());
        self.taken.push_back(Taken { png: recording.film()?, name });
        Ok(())
    }
    async fn pull(&mut self, across: f64, up: f64) -> Result<(), Error> {
        let Some(sign) = self.hand.tool.sign() else { return Ok(()) };
        if self.paused {
            if self.fault.is_none() {
                self.say(STILL);
            }
            return Ok(());
        }
        self.stage.pull(across, up, self.hand.reach, sign * self.hand.strength).await
    }
    async fn choose(&mut self, across: f64, up: f64) -> Result<(), Error> {
        let place = self.stage.found(across, up).await?;
        self.chosen = match place {
            Some(place) => Chosen::at(&mut self.stage.simulation, place).await?,
            None => None,
        };
        Ok(())
    }
    /// Makes steps, also when it is paused.
    ///
    /// # Errors
    /// What stops the run, and when the device is lost, out of memory or does not answer in time.
    pub async fn step(&mut self, steps: u32) -> Result<(), Error> {
        let begun = Instant::now();
        if steps == 0 {
            return Ok(());
        }
        self.changed();
        self.stage.advance(steps).await?;
        self.pace.stepped(steps, begun.elapsed());
        if self.plots.is_due() {
            self.measure().await?;
        }
        Ok(())
    }
    /// Says why something was not done. An error of the device ends the view.
    fn refuse(&mut self, error: Error) -> Result<(), Error> {
        if matches!(error, Error::Device(_) | Error::Timeout { .. } | Error::OutOfMemory(_)) {
            return Err(error);
        }
        self.say(error.to_string());
        Ok(())
    }
    async fn act(&mut self, action: Action) -> Result<(), Error> {
        match action {
            Action::Pause => self.pause(!self.paused),
            Action::Step => {
                self.paused = true;
                self.step(1).await?;
            }
            Action::Reset => {
                self.stage.reset().await?;
                self.restarted();
            }
            Action::Restore => {
                self.stage.restore().await?;
                self.restarted();
            }
            Action::Faster(factor) => self.pace.faster(factor),
            Action::Set { force, setting, value } => {
                if let Some(text) = self.stage.set(&force, &setting, value).await? {
                    self.message = text;
                }
                self.measured = None;
                self.plots.follow(self.stage.simulation.setup())?;
            }
            Action::Picture { key, value } => self.stage.look(key, value).await?,
            Action::Orbit { across, up } => self.stage.camera(|camera| orbit::turned(camera, across, up)),
            Action::Pan { across, up } => self.stage.camera(|camera| orbit::shifted(camera, across, up)),
            Action::Zoom { factor, across, up } => {
                self.stage.camera(|camera| orbit::zoomed(camera, factor, across, up));
            }
            Action::From { back, up } => self.stage.camera(|camera| orbit::from(camera, back, up)),
            Action::Projection => self.stage.camera(orbit::other_projection),
            Action::Frame => self.stage.frame().await?,
            Action::Fly { right, up, forward } => {
                self.stage.camera(|camera| orbit::flown(camera, right, up, forward));
            }
            Action::Turn { across, up } => self.stage.camera(|camera| orbit::looked(camera, across, up)),
            Action::Use(tool) => {
                // What was begun with another one ends.
                self.hand.begun = None;
                self.hand.tool = tool;
                self.stage.release()?;
            }
            Action::Pull { across, up } => self.pull(across, up).await?,
            Action::Release => self.stage.release()?,
            // Escape ends a drag as well.
            Action::Place { .. } if !self.hand.tool.places() => (),
            Action::Place { from, to } => {
                self.stage.place(self.hand.tool, from, to).await?;
                self.hand.tool = Tool::Look;
            }
            Action::Remove => self.stage.remove().await?,
            Action::Choose { across, up } => self.choose(across, up).await?,
            Action::Follow => {
                if let Some(chosen) = &mut self.chosen {
                    chosen.follow = !chosen.follow;
                }
            }
            Action::LetGo => self.chosen = None,
            Action::Plot(column) => {
                if let Some(chosen) = &mut self.chosen {
                    chosen.plot(column);
                }
            }
            Action::Panel => self.panel = !self.panel,
            Action::Help => self.help = !self.help,
            Action::Scenes => self.scenes = !self.scenes,
            Action::Copy => self.copy(),
            Action::Take => {
                let (image, name) = self.stage.take().await?;
                self.taken.push_back(Taken { png: image.png()?, name });
            }
            Action::Record if self.recording.is_some() => self.end_recording()?,
            Action::Record => self.recording = Some(Recording::new(self.size)),
            Action::Open(name) => self.wanted = Some(name),
        }
        Ok(())
    }
    /// Copies what was changed, as arguments of the command.
    fn copy(&mut self) {
        let changes = self.stage.changes();
        let what = match changes.len() {
            0 => "nothing was changed: the command".to_owned(),
            1 => "the command with the value that was changed".to_owned(),
            many => format!("the command with the {many} values that were changed"),
        };
        self.copied = Some((self.command)(&changes));
        self.say(format!("{what} is on the clipboard"));
    }
    fn restarted(&mut self) {
        self.measured = None;
        self.plots.restarted(&self.stage.present());
        self.chosen.iter_mut().for_each(Chosen::restarted);
        self.message.clear();
        if self.fault.take().is_some() {
            self.paused = false;
        }
    }
    /// Whether it lies in a plane and is seen from above: a camera that turns would show nothing new.
    fn is_flat(&self) -> bool {
        let bounds = self.stage.simulation.setup().bounds;
        bounds.dimensions == 2 && self.stage.picture().frame.camera.back.z > 0.999
    }
}
