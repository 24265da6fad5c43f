//! `motes view`

#[cfg(feature = "view")]
mod files;
#[cfg(feature = "view")]
mod sheet;
#[cfg(feature = "view")]
mod window;

#[cfg(feature = "view")]
use std::path::PathBuf;

use super::args::ViewArgs;
use super::failure::Failure;
#[cfg(feature = "view")]
use super::load::Loaded;

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

/// Loads a scene with the arguments. Adds the files on which this depends, also where there are faults.
#[cfg(feature = "view")]
async fn load(args: &ViewArgs, origin: &Origin, files: &mut Vec<PathBuf>) -> Result<Loaded, Failure> {
    use motes::scene::{Beside, Options, Source};
    let beside: Vec<PathBuf> = origin.beside.iter().map(PathBuf::from).collect();
    files.extend_from_slice(&beside);
    if let Source::File(path) = &origin.source {
        files.extend(std::path::absolute(path));
    }
    let replaced = origin.beside.iter().any(|file| Beside::of(file) == Some(Beside::Particles));
    let values = args.overrides.iter().filter(|_| origin.own);
    // Sizes and values of the scene's own particles are none of others.
    let values = values.filter(|value| !(replaced && value.trim_start().starts_with("particles.")));
    let scale = args.scale.filter(|_| origin.own && !replaced);
    let mut source = origin.source.clone();
    for file in &origin.beside {
        source = source.beside(file)?;
    }
    let options = Options { allow_outside: args.allow_outside, beside, ..Options::default() };
    let scene = super::engine::load_scaled(&source, values.cloned().collect(), scale, &options);
    match &scene {
        Ok(scene) => files.extend_from_slice(&scene.files),
        Err(Failure::Scene(faults)) => files.extend_from_slice(&faults.files),
        Err(_) => (),
    }
    super::load::examined(scene?).await
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
    /// The command that opens it with the arguments. Files beside it are left out: a command has none.
    fn command(&self, args: &ViewArgs) -> motes::view::Command {
        use super::shell::quoted;
        use motes::scene::Source;
        let set = |value: &String| format!(" --set {}", quoted(value));
        let name = match &self.source {
            Source::File(path) => path.display().to_string(),
            Source::Builtin(scene) => scene.name.to_owned(),
            Source::Text { name, .. } | Source::Memory { name, .. } => name.clone(),
        };
        let mut words = format!("motes view {}", quoted(&name));
        if self.own {
            words.extend(args.scale.map(|factor| format!(" --scale {factor}")));
            words.extend(args.overrides.iter().map(set));
        }
        if args.allow_outside {
            words += " --allow-outside";
        }
        Box::new(move |changes| changes.iter().fold(words.clone(), |all, value| all + &set(value)))
    }
    /// The same with a file beside it, after those before.
    fn with(&self, file: &str) -> Self {
        let mut all = self.clone();
        all.beside.retain(|known| known != file);
        all.beside.push(file.to_owned());
        all
    }
}
