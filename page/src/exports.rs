//! What the page's script calls.

use std::rc::Rc;

use motes::scene::{Beside, SCENES, Source};
use wasm_bindgen::prelude::*;
use web_sys::HtmlCanvasElement;

use super::shell::Shell;
use super::viewer::Wanted;

/// The viewer on a canvas.
#[wasm_bindgen]
pub struct Viewer(Rc<Shell>);

/// What a file can be for a scene, by its extension: `law`, `particles`, `plan`, or nothing.
#[wasm_bindgen(js_name = kindOf)]
#[must_use]
pub fn kind_of(name: &str) -> Option<String> {
    let word = match Beside::of(name)? {
        Beside::Law => "law",
        Beside::Particles => "particles",
        Beside::Plan => "plan",
    };
    Some(word.to_owned())
}

/// The text of a scene in which a file has a part: particles or a floor plan in the place of its own, or one more law, of which the text is needed.
///
/// # Errors
/// When the file is of another kind, or the scene is no TOML.
#[wasm_bindgen(js_name = withFile)]
pub fn with_file(text: &str, name: &str, law: &str) -> Result<String, JsError> {
    Ok(motes::scene::with_file(text, name, law)?)
}

/// A built-in scene.
#[wasm_bindgen(getter_with_clone)]
pub struct BuiltIn {
    /// Its name.
    pub name: String,
    /// Its text.
    pub text: String,
    /// Names and texts of the files that it names, one after the other.
    pub files: Vec<String>,
}

/// How a run stands.
#[wasm_bindgen(getter_with_clone)]
pub struct Status {
    /// The scene.
    pub scene: String,
    /// Steps done.
    pub steps: f64,
    /// Whether it stands still.
    pub paused: bool,
    /// What is said to the user.
    pub message: String,
    /// Why the run has ended, if it has.
    pub failed: Option<String>,
    /// A scene that the panel asks for.
    pub asked: Option<String>,
    /// A picture or a film that was taken: its name.
    pub picture: Option<String>,
    /// Its bytes.
    pub png: Vec<u8>,
}

/// The built-in scenes.
#[wasm_bindgen(js_name = builtIn)]
#[must_use]
pub fn built_in() -> Vec<BuiltIn> {
    let files =
        |of: &[(&str, &str)]| of.iter().flat_map(|(name, text)| [(*name).to_owned(), (*text).to_owned()]).collect();
    let scenes = SCENES.iter();
    scenes.map(|of| BuiltIn { name: of.name.to_owned(), text: of.text.to_owned(), files: files(of.files) }).collect()
}

#[wasm_bindgen]
impl Viewer {
    /// Opens a canvas.
    ///
    /// # Errors
    /// When the browser gives no device.
    pub async fn open(canvas: HtmlCanvasElement) -> Result<Self, JsError> {
        std::panic::set_hook(Box::new(|panic| wasm_bindgen::throw_str(&panic.to_string())));
        Ok(Self(Shell::open(canvas).await?))
    }
    /// Holds a file of bytes, such as particles, for scenes that name it.
    pub async fn hold(&self, name: String, bytes: Vec<u8>) {
        self.0.viewer.lock().await.hold(name, bytes);
    }
    /// Opens a scene: a text of this name with the files that it names (name and text, one after the other), values in the form of `--set`,
    /// and a factor of the number of particles. It stands still at first if it is `paused`. Returns remarks.
    ///
    /// # Errors
    /// What is wrong with it, with its place. The present scene goes on.
    pub async fn load(
        &self,
        name: String,
        text: String,
        files: Vec<String>,
        overrides: Vec<String>,
        scale: Option<f64>,
        paused: bool,
    ) -> Result<Vec<String>, JsError> {
        let files = files.as_chunks().0.iter();
        let files = files.map(|[name, text]| (name.clone(), text.clone().into_bytes())).collect();
        let source = Source::Memory { name: format!("{name}.toml"), text, files };
        let wanted = Wanted { source, overrides, scale, paused };
        let loaded = self.0.viewer.lock().await.load(&wanted).await;
        self.0.wake();
        loaded.map_err(|why| JsError::new(&why))
    }
    /// Runs so many steps, stands still then, and measures: the time, kinetic and potential energy.
    ///
    /// # Errors
    /// What stopped the run.
    pub async fn advance(&self, steps: u32) -> Result<Vec<f64>, JsError> {
        let energy = self.0.viewer.lock().await.advance(steps).await?;
        self.0.wake();
        Ok(vec![energy.time, energy.kinetic, energy.potential])
    }
    /// What was changed by hand in forces, picture and camera, in the form of `--set`: `force.0.softening=0.1`.
    pub async fn changes(&self) -> Vec<String> {
        self.0.viewer.lock().await.changes()
    }
    /// How the run stands.
    pub async fn status(&self) -> Result<Status, JsError> {
        let mut viewer = self.0.viewer.lock().await;
        let (scene, steps, message) = viewer.status();
        let (asked, taken, paused) = (viewer.asked(), viewer.taken(), viewer.is_paused());
        let (picture, png) = match taken {
            Some(taken) => (Some(taken.name), taken.png),
            None => (None, Vec::new()),
        };
        #[expect(clippy::cast_precision_loss, reason = "steps are fewer than 2^32")]
        let steps = steps as f64;
        Ok(Status { scene, steps, paused, message, failed: self.0.failed(), asked, picture, png })
    }
}
