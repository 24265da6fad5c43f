//! `motes view`

#[cfg(feature = "view")]
mod files;
#[cfg(feature = "view")]
mod sheet;
#[cfg(feature = "view")]
mod window;

use super::args::ViewArgs;
use super::failure::Failure;

/// Opens a window in which a scene runs, or draws its frames without one.
#[cfg(feature = "view")]
pub async fn view(args: &ViewArgs) -> Result<(), Failure> {
    match &args.screenshot {
        Some(file) => Box::pin(sheet::draw(args, file)).await,
        None => window::run(args),
    }
}

/// A build without the feature `view` opens no window.
#[cfg(not(feature = "view"))]
#[expect(clippy::unused_async, reason = "as with the feature")]
pub async fn view(args: &ViewArgs) -> Result<(), Failure> {
    Err(motes::Error::NoAdapter(format!(
        "this build of motes opens no window: build it with the feature `view`, as in `cargo run --release --features view -- view {}`",
        args.scene
    ))
    .into())
}

/// The origin of a scene.
#[cfg(feature = "view")]
#[derive(Clone)]
struct Origin {
    source: motes::scene::Source,
    /// Whether it is the scene of the arguments, with their values.
    own: bool,
    /// Files that were put beside it by hand, one after the other.
    beside: Vec<String>,
}

/// Loads a scene with the arguments.
#[cfg(feature = "view")]
async fn load(args: &ViewArgs, origin: &Origin) -> Result<super::load::Loaded, Failure> {
    use super::args::{BackendChoice, DeviceArgs, SceneArgs};
    use motes::scene::{Beside, Source};
    let replaced = origin.beside.iter().any(|file| Beside::of(file) == Some(Beside::Particles));
    let values = args.overrides.iter().filter(|_| origin.own);
    let scene = SceneArgs {
        scene: args.scene.clone(),
        steps: None,
        until: None,
        // Sizes and values of the scene's own particles are none of others.
        overrides: values
            .filter(|value| !(replaced && value.trim_start().starts_with("particles.")))
            .cloned()
            .collect(),
        scale: args.scale.filter(|_| origin.own && !replaced),
        // What was put beside it may be anywhere.
        allow_outside: args.allow_outside || !origin.beside.is_empty(),
        auto_substeps: false,
        device: DeviceArgs { backend: BackendChoice::Gpu, adapter: args.adapter.clone() },
    };
    let mut source = origin.source.clone();
    for file in &origin.beside {
        source = source.beside(file)?;
    }
    let mut loaded = super::load::load_from(&source, &scene, &[]).await?;
    if let (Source::File(path), false) = (&origin.source, origin.beside.is_empty()) {
        loaded.scene.files.push(path.clone());
    }
    Ok(loaded)
}

#[cfg(feature = "view")]
impl Origin {
    /// The scene of the arguments, or another one of this name.
    fn find(args: &ViewArgs, name: &str) -> Result<Self, Failure> {
        let source = motes::scene::Source::find(name)?;
        Ok(Self { source, own: name == args.scene, beside: Vec::new() })
    }
    /// Whether it is the same scene, perhaps with other files beside it.
    fn is_of(&self, other: &Self) -> bool {
        use motes::scene::Source;
        match (&self.source, &other.source) {
            (Source::File(one), Source::File(two)) => one == two,
            (Source::Builtin(one), Source::Builtin(two)) => one.name == two.name,
            _ => false,
        }
    }
    /// The same with a file beside it, after those before.
    fn with(&self, file: &str) -> Self {
        let mut all = self.clone();
        all.beside.retain(|known| known != file);
        all.beside.push(file.to_owned());
        all
    }
}
