//! The window.

use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Instant, SystemTime};

use egui::{ColorImage, Context, TextureHandle, TextureOptions, ViewportId};
use egui_winit::winit;
use motes::gpu::{Choice, Controls, Found, Window as Surface};
use motes::view::{Command, PICTURE, Taken, View};
use motes::{Error, Gpu, Simulation};
use pollster::block_on;
use winit::application::ApplicationHandler;
use winit::dpi::PhysicalSize;
use winit::event::{StartCause, WindowEvent};
use winit::event_loop::{ActiveEventLoop, ControlFlow, EventLoop};
use winit::window::{Window, WindowId};

use super::super::args::ViewArgs;
use super::super::failure::Failure;
use super::super::load::Loaded;
use super::Origin;
use super::files::{Files, LOOK};

/// Opens the window, and returns when it is closed.
pub fn run(args: &ViewArgs) -> Result<(), Failure> {
    let mut app = App { args: args.clone(), shell: None, failed: None };
    let events = EventLoop::new().map_err(|error| refused(&error))?;
    events.run_app(&mut app).map_err(|error| refused(&error))?;
    app.failed.map_or(Ok(()), Err)
}

/// A window that cannot be opened. Where a system's error stands in the source of a library is left out.
fn refused(error: &dyn std::fmt::Display) -> Error {
    let text = error.to_string();
    let why =
        text.rsplit_once(".rs:").and_then(|(_, rest)| rest.split_once(": ")).map_or(text.as_str(), |(_, why)| why);
    Error::NoAdapter(format!(
        "no window can be opened: {}; `--frames N --screenshot FILE` draws without one",
        why.trim_end_matches('.')
    ))
}

struct App {
    args: ViewArgs,
    shell: Option<Shell>,
    failed: Option<Failure>,
}

impl App {
    fn end(&mut self, events: &ActiveEventLoop, result: Result<(), Failure>) {
        self.failed = result.err();
        self.shell = None;
        events.exit();
    }
}

impl ApplicationHandler for App {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        if self.shell.is_some() {
            return;
        }
        match Shell::open(events, &self.args) {
            Ok(shell) => self.shell = Some(shell),
            Err(failure) => self.end(events, Err(failure)),
        }
    }
    fn new_events(&mut self, events: &ActiveEventLoop, cause: StartCause) {
        let (StartCause::ResumeTimeReached { .. }, Some(shell)) = (cause, &mut self.shell) else { return };
        let done = shell.look(&self.args);
        if done.is_err() {
            let saved = shell.close();
            self.end(events, done.and(saved));
        }
    }
    fn about_to_wait(&mut self, events: &ActiveEventLoop) {
        let Some(shell) = &self.shell else { return };
        let look = Instant::now() + LOOK;
        events.set_control_flow(ControlFlow::WaitUntil(shell.again.map_or(look, |again| again.min(look))));
    }
    fn window_event(&mut self, events: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(shell) = &mut self.shell else { return };
        // A redraw is no input: each would ask for the next one.
        let input = !matches!(event, WindowEvent::RedrawRequested);
        if input && shell.input.on_window_event(&shell.window, &event).repaint {
            shell.window.request_redraw();
        }
        let done = match event {
            WindowEvent::CloseRequested => {
                let saved = shell.close();
                return self.end(events, saved);
            }
            WindowEvent::Resized(size) => shell.surface.resize(size.into()).map_err(Failure::from),
            WindowEvent::DroppedFile(path) => {
                shell.drop(&self.args, &path);
                Ok(())
            }
            WindowEvent::RedrawRequested => shell.frame(&self.args),
            _ => Ok(()),
        };
        let enough = self.args.frames.is_some_and(|frames| shell.frames >= frames);
        if done.is_err() || enough {
            // A film is not lost with the device.
            let saved = shell.close();
            self.end(events, done.and(saved));
        }
    }
}

/// The window with what it shows.
struct Shell {
    window: Arc<Window>,
    surface: Surface,
    found: Found,
    context: Context,
    input: egui_winit::State,
    view: View<Gpu>,
    /// Pictures of the scenes that come with motes.
    contact: TextureHandle,
    files: Files,
    origin: Origin,
    /// What was to be opened last in its place and has faults: it is tried again when its files change, unless those of the present scene do.
    faulty: Option<(Origin, Files)>,
    frames: u64,
    /// When the controls are to be drawn again without input: a cursor blinks, a tip appears.
    again: Option<Instant>,
}

impl Shell {
    fn open(events: &ActiveEventLoop, args: &ViewArgs) -> Result<Self, Failure> {
        let begun = SystemTime::now();
        let origin = Origin::find(args, &args.scene)?;
        let mut files = Vec::new();
        let loaded = block_on(super::load(args, &origin, &mut files))?;
        let [width, height] = args.size;
        let attributes = Window::default_attributes()
            .with_title(format!("motes: {}", loaded.scene.name))
            .with_inner_size(PhysicalSize::new(width, height));
        let window = Arc::new(events.create_window(attributes).map_err(|error| refused(&error))?);
        let choice = args.adapter.clone().map_or(Choice::Best, Choice::Named);
        let (surface, found) = block_on(Surface::open(window.clone(), window.inner_size().into(), &choice))?;
        let context = Context::default();
        let input = egui_winit::State::new(context.clone(), ViewportId::ROOT, &window, None, window.theme(), None);
        let files = Files::of(&files, begun);
        let contact = context.load_texture("scenes", contact()?, TextureOptions::LINEAR);
        let view = block_on(watched(loaded, &found, &contact, origin.command(args)))?;
        window.request_redraw();
        Ok(Self {
            window,
            surface,
            found,
            context,
            input,
            view,
            contact,
            files,
            origin,
            faulty: None,
            frames: 0,
            again: None,
        })
    }
    /// Opens a scene that was dropped on the window, or the present one with another file.
    fn drop(&mut self, args: &ViewArgs, path: &Path) {
        let is_scene = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
        let file = std::path::absolute(path).unwrap_or_else(|_| path.to_owned());
        let name = file.to_string_lossy();
        self.open_scene(args, if is_scene { Origin::find(args, &name) } else { Ok(self.origin.with(&name)) });
    }
    /// Opens another scene. Where it has faults, the present one goes on, and they are said.
    fn open_scene(&mut self, args: &ViewArgs, origin: Result<Origin, Failure>) {
        let begun = SystemTime::now();
        let (mut files, mut tried) = (Vec::new(), None);
        let opened = block_on(async {
            let origin = tried.insert(origin?);
            let loaded = super::load(args, origin, &mut files).await?;
            let title = loaded.scene.name.clone();
            let mut view = watched(loaded, &self.found, &self.contact, origin.command(args)).await?;
            if origin.is_of(&self.origin) {
                view.follow(&self.view);
            }
            Ok::<_, Failure>((view, title))
        });
        match opened {
            Ok((view, title)) => {
                let mut before = std::mem::replace(&mut self.view, view);
                let ended = before.end();
                let saved = save_all(&mut before);
                self.saved(ended.and(saved));
                (self.files, self.faulty) = (Files::of(&files, begun), None);
                self.origin = tried.unwrap_or_else(|| self.origin.clone());
                self.window.set_title(&format!("motes: {title}"));
            }
            Err(failure) => {
                self.view.say(failure.words());
                match tried {
                    Some(origin) if origin.is_of(&self.origin) && origin.beside == self.origin.beside => {
                        // What it read before may be named again.
                        files.extend(self.files.paths().cloned());
                        (self.files, self.faulty) = (Files::of(&files, begun), None);
                    }
                    Some(origin) => self.faulty = Some((origin, Files::of(&files, begun))),
                    None => (),
                }
            }
        }
        self.window.request_redraw();
    }
    /// Says which files were saved, or why not.
    fn saved(&mut self, files: Result<Vec<PathBuf>, Error>) {
        match files {
            Ok(files) if files.is_empty() => (),
            Ok(files) => {
                let names: Vec<String> = files.iter().map(|file| file.display().to_string()).collect();
                self.view.say(format!("saved {}", names.join(", ")));
            }
            Err(why) => self.view.say(why.to_string()),
        }
    }
    /// Saves what was taken when it ends.
    fn close(&mut self) -> Result<(), Failure> {
        let ended = self.view.end();
        let saved = save_all(&mut self.view);
        saved.and(ended).map_err(Failure::from)
    }
    /// Reads a scene again when its files have changed, and asks for the frame that controls wait for. At rest this is all that is done.
    fn look(&mut self, args: &ViewArgs) -> Result<(), Failure> {
        self.found.faults.check()?;
        if self.again.take_if(|again| *again <= Instant::now()).is_some() {
            self.window.request_redraw();
        }
        if self.files.changed() {
            self.open_scene(args, Ok(self.origin.clone()));
        } else if let Some((origin, _)) = self.faulty.take_if(|(_, files)| files.changed()) {
            self.open_scene(args, Ok(origin));
        }
        Ok(())
    }
    /// One frame: input, controls, steps, picture.
    fn frame(&mut self, args: &ViewArgs) -> Result<(), Failure> {
        self.look(args)?;
        let input = self.input.take_egui_input(&self.window);
        let mut output = self.context.run_ui(input, |ui| self.view.controls(ui));
        self.input.handle_platform_output(&self.window, std::mem::take(&mut output.platform_output));
        let delay = output.viewport_output.values().map(|viewport| viewport.repaint_delay).min();
        // Where nothing is to be drawn again, the delay is longer than any time.
        self.again = delay.and_then(|delay| Instant::now().checked_add(delay));
        let controls = Controls::of(&self.context, output);
        block_on(self.view.advance())?;
        let files = save_all(&mut self.view);
        self.saved(files);
        if let Some(name) = self.view.wanted() {
            self.open_scene(args, Origin::find(args, &name));
            block_on(self.view.advance())?;
        }
        let size = self.view.size();
        if let Some(pixels) = self.view.simulation().buffer(PICTURE) {
            let id = self.surface.canvas().take(pixels, size)?;
            self.view.show(id);
        }
        self.surface.paint(&controls)?;
        self.frames += 1;
        // A number of frames that is asked for is drawn at rest as well.
        if !self.view.rests() || self.frames < 3 || args.frames.is_some() {
            self.window.request_redraw();
        }
        Ok(())
    }
}

/// The contact sheet of the scenes.
fn contact() -> Result<ColorImage, Error> {
    let bad = |why: String| Error::Device(format!("the pictures of scenes cannot be read: {why}"));
    let file = std::io::Cursor::new(include_bytes!("../../../scenes/contact.png"));
    let mut reader = png::Decoder::new(file).read_info().map_err(|why| bad(why.to_string()))?;
    let mut rgb = vec![0; reader.output_buffer_size().ok_or_else(|| bad("it is too large".to_owned()))?];
    let info = reader.next_frame(&mut rgb).map_err(|why| bad(why.to_string()))?;
    let (wide, high) = (info.width as usize, info.height as usize);
    if rgb.len() != 3 * wide * high {
        return Err(bad("it is not in red, green and blue of a byte each".to_owned()));
    }
    Ok(ColorImage::from_rgb([wide, high], &rgb))
}

/// A view of a scene on a device, with pictures of the others.
async fn watched(loaded: Loaded, found: &Found, contact: &TextureHandle, command: Command) -> Result<View<Gpu>, Error> {
    let (device, queue) = (found.device.clone(), found.queue.clone());
    let make = Box::new(move |setup: &_| Simulation::new(&device, &queue, setup));
    let mut view = View::new(&loaded.scene, loaded.setup, make).await?;
    view.contact(contact.id());
    view.opened_by(command);
    Ok(view)
}

/// Saves all that was taken.
fn save_all(view: &mut View<Gpu>) -> Result<Vec<PathBuf>, Error> {
    // One that cannot be saved does not keep the others from it.
    let all: Vec<_> = std::iter::from_fn(|| view.take()).map(|taken| save(&taken)).collect();
    all.into_iter().collect()
}

/// Saves a picture in the present folder, beside those that are there.
fn save(taken: &Taken) -> Result<PathBuf, Error> {
    let stem = taken.name.trim_end_matches(".png");
    let names = std::iter::once(taken.name.clone()).chain((2..).map(|number| format!("{stem}_{number}.png")));
    let file = names.map(PathBuf::from).find(|name| !name.exists()).unwrap_or_default();
    motes::formats::atomically(&file, |out| out.write_all(&taken.png))?;
    Ok(file)
}

#[cfg(test)]
mod tests {
    #[test]
    fn what_a_system_says_is_kept_and_places_in_sources_are_not() {
        let said = |text: &str| super::refused(&text).to_string();
        let system = said(
            "os error at /a/winit-0.30/src/platform_impl/linux/mod.rs:765: neither WAYLAND_DISPLAY nor DISPLAY is set.",
        );
        assert!(system.ends_with("no window can be opened: neither WAYLAND_DISPLAY nor DISPLAY is set; `--frames N --screenshot FILE` draws without one"), "{system}");
        assert!(said("not supported").contains("opened: not supported; "));
    }
}
