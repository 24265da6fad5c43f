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
    use motes::scene::Source;
    let options = origin.options(args);
    files.extend_from_slice(&options.beside);
    if let Source::File(path) = &origin.source {
        files.extend(std::path::absolute(path));
    }
    let (values, scale) = origin.given(args);
    let scene = super::engine::load_scaled(&origin.opened()?, values, scale, &options);
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
        let (source, own) = (motes::scene::Source::find(name)?, name == args.scene);
        let beside = if own { args.beside.clone() } else { Vec::new() };
        let origin = Self { source, own, beside };
        let (values, scale) = origin.given(args);
        if own && (values.len() < args.overrides.len() || scale != args.scale) {
            let why = "--beside puts its particles in the place of the scene's own, to which --scale and --set particles.… \
                       belong: leave these out, or write a scene with the file";
            return Err(motes::Error::Scene(why.to_owned()).into());
        }
        Ok(origin)
    }
    /// The scene with the files beside it.
    fn opened(&self) -> Result<motes::scene::Source, motes::Error> {
        self.beside.iter().try_fold(self.source.clone(), |source, file| source.beside(file))
    }
    fn options(&self, args: &ViewArgs) -> motes::scene::Options {
        let beside = self.beside.iter().map(PathBuf::from).collect();
        motes::scene::Options { allow_outside: args.allow_outside, beside, ..motes::scene::Options::default() }
    }
    /// The values and the factor of the arguments that are for it. Those for the scene's own particles are not for others in their place.
    fn given(&self, args: &ViewArgs) -> (Vec<String>, Option<f64>) {
        use motes::scene::Beside;
        if !self.own {
            return (Vec::new(), None);
        }
        let replaced = self.beside.iter().any(|file| Beside::of(file) == Some(Beside::Particles));
        let meant = |value: &&String| !(replaced && value.trim_start().starts_with("particles."));
        (args.overrides.iter().filter(meant).cloned().collect(), args.scale.filter(|_| !replaced))
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
    /// The command that opens it with the arguments, and with the files beside it.
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
        let (values, scale) = self.given(args);
        words.extend(values.iter().map(set));
        words.extend(self.beside.iter().map(|file| format!(" --beside {}", quoted(file))));
        if args.allow_outside {
            words += " --allow-outside";
        }
        words.extend(args.adapter.iter().map(|adapter| format!(" --adapter {}", quoted(adapter))));
        let (origin, options) = (self.clone(), self.options(args));
        Box::new(move |changes| {
            let mut words = words.clone();
            if let Some(factor) = scale {
                // A factor is taken of a scene with all values: what was changed later is none of its values.
                let scaled = || {
                    let source = origin.opened().ok()?;
                    motes::scene::Scene::load(&source, &values, &options).ok()?.scaled(factor).ok()
                };
                match (!changes.is_empty()).then(scaled).flatten() {
                    Some(scaled) => words.extend(scaled.iter().map(set)),
                    None => words += &format!(" --scale {factor}"),
                }
            }
            words.extend(changes.iter().map(set));
            words
        })
    }
    /// The same with a file beside it, after those before.
    fn with(&self, file: &str) -> Self {
        let mut all = self.clone();
        all.beside.retain(|known| known != file);
        all.beside.push(file.to_owned());
        all
    }
}

#[cfg(all(test, feature = "view"))]
mod tests {
    use clap::Parser;

    use super::*;
    use crate::cli::args::{Args, Command};

    fn command(words: &[&str], changes: &[&str]) -> String {
        let args = Args::try_parse_from(["motes", "view"].iter().chain(words)).expect("arguments");
        let Command::View(args) = args.command else { panic!("view") };
        let origin = Origin::find(&args, &args.scene).unwrap_or_else(|_| panic!("a scene"));
        let changes: Vec<String> = changes.iter().map(|change| (*change).to_owned()).collect();
        origin.command(&args)(&changes)
    }

    /// A factor is taken of all values: what is changed later would be scaled with them.
    #[test]
    fn a_factor_is_written_as_its_values_where_some_were_changed() {
        let words = ["dam_break_2d", "--scale", "0.25", "--set", "simulation.dt=1e-3"];
        assert_eq!(command(&words, &[]), "motes view dam_break_2d --set simulation.dt=1e-3 --scale 0.25");
        let changed = command(&words, &["force.1.spacing=0.07"]);
        assert!(!changed.contains("--scale"), "{changed}");
        let spacings: Vec<&str> = changed.split(" --set ").filter(|set| set.starts_with("force.1.spacing=")).collect();
        assert_eq!((spacings.len(), spacings.last()), (2, Some(&"force.1.spacing=0.07")), "{changed}");
    }
    #[test]
    fn files_beside_a_scene_and_an_adapter_are_given_too() {
        let words = ["plummer", "--beside", "a law.wgsl", "--adapter", "llvmpipe"];
        assert_eq!(
            command(&words, &["force.1.params.k=2.0"]),
            "motes view plummer --beside 'a law.wgsl' --adapter llvmpipe --set force.1.params.k=2.0"
        );
    }
}
