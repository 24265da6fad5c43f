//! The canvas as a window: its events, and one frame after the other.

use std::cell::{Cell, RefCell};
use std::rc::Rc;
use std::sync::Arc;

use egui::{Context, ViewportId};
use egui_winit::winit;
use futures_intrusive::channel::LocalOneshotChannel;
use futures_intrusive::sync::LocalMutex;
use motes::Error;
use wasm_bindgen_futures::spawn_local;
use web_sys::HtmlCanvasElement;
use winit::application::ApplicationHandler;
use winit::event::WindowEvent;
use winit::event_loop::{ActiveEventLoop, EventLoop};
use winit::platform::web::{EventLoopExtWebSys as _, WindowAttributesExtWebSys as _};
use winit::window::{Window, WindowId};

use super::viewer::Viewer;

/// Frames that are drawn although nothing moves: the first ones find the places of things.
const FIRST: u64 = 4;

/// What events and frames share. The page has one thread; what a frame awaits lets events through.
pub struct Shell {
    pub window: Arc<Window>,
    input: RefCell<egui_winit::State>,
    pub viewer: LocalMutex<Viewer>,
    /// Whether a frame is being made.
    busy: Cell<bool>,
    frames: Cell<u64>,
    /// Why no more frames are made.
    failed: RefCell<Option<String>>,
}

impl Shell {
    /// Opens a canvas.
    ///
    /// # Errors
    /// When there is no device that can draw on it.
    pub async fn open(canvas: HtmlCanvasElement) -> Result<Rc<Self>, Error> {
        let refused = |why: &dyn std::fmt::Display| Error::NoAdapter(format!("the canvas cannot be opened: {why}"));
        let events = EventLoop::new().map_err(|why| refused(&why))?;
        let opened = Rc::new(LocalOneshotChannel::new());
        let shell = Rc::new(RefCell::new(None));
        events.spawn_app(App { canvas: Some(canvas), opened: opened.clone(), shell: shell.clone() });
        let window: Arc<Window> =
            opened.receive().await.unwrap_or_else(|| Err("no answer".to_owned())).map_err(|why| refused(&why))?;
        let context = Context::default();
        // As the rest of the page.
        context.set_theme(egui::Theme::Dark);
        let input = egui_winit::State::new(context.clone(), ViewportId::ROOT, &window, None, window.theme(), None);
        let viewer = LocalMutex::new(Viewer::open(window.clone(), context).await?, true);
        let made = Rc::new(Self {
            window,
            input: RefCell::new(input),
            viewer,
            busy: Cell::new(false),
            frames: Cell::new(0),
            failed: RefCell::default(),
        });
        shell.replace(Some(made.clone()));
        Ok(made)
    }
    /// Draws again, also what stands still.
    pub fn wake(&self) {
        self.frames.set(0);
        self.window.request_redraw();
    }
    /// Why no more frames are made, if so.
    pub fn failed(&self) -> Option<String> {
        self.failed.borrow().clone()
    }
    /// Makes a frame, unless one is being made.
    fn draw(self: &Rc<Self>) {
        if self.failed.borrow().is_some() || self.busy.replace(true) {
            return;
        }
        let shell = self.clone();
        spawn_local(async move {
            let again = shell.frame().await;
            shell.busy.set(false);
            match again {
                Ok(true) => shell.window.request_redraw(),
                Ok(false) => (),
                Err(why) => {
                    let ended = shell.viewer.lock().await.close().err();
                    let more = ended.map_or(String::new(), |more| format!("; {more}"));
                    *shell.failed.borrow_mut() = Some(format!("{why}{more}"));
                }
            }
        });
    }
    async fn frame(&self) -> Result<bool, Error> {
        let mut viewer = self.viewer.lock().await;
        let input = self.input.borrow_mut().take_egui_input(&self.window);
        let frame = viewer.frame(input, self.window.inner_size()).await?;
        self.input.borrow_mut().handle_platform_output(&self.window, frame.platform);
        self.frames.set(self.frames.get() + 1);
        Ok(frame.soon || !viewer.rests() || self.frames.get() < FIRST)
    }
}

/// The window, or why there is none.
type Opened = Rc<LocalOneshotChannel<Result<Arc<Window>, String>>>;

struct App {
    canvas: Option<HtmlCanvasElement>,
    opened: Opened,
    shell: Rc<RefCell<Option<Rc<Shell>>>>,
}

impl ApplicationHandler for App {
    fn resumed(&mut self, events: &ActiveEventLoop) {
        let Some(canvas) = self.canvas.take() else { return };
        let window = events.create_window(Window::default_attributes().with_canvas(Some(canvas)));
        // It is sent once.
        let _ = self.opened.send(window.map(Arc::new).map_err(|why| why.to_string()));
    }
    fn window_event(&mut self, _: &ActiveEventLoop, _: WindowId, event: WindowEvent) {
        let Some(shell) = self.shell.borrow().clone() else { return };
        match event {
            WindowEvent::RedrawRequested => shell.draw(),
            WindowEvent::Resized(_) => shell.wake(),
            event => {
                if shell.input.borrow_mut().on_window_event(&shell.window, &event).repaint {
                    shell.window.request_redraw();
                }
            }
        }
    }
}
