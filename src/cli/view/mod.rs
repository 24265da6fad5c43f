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

/// The scene of the arguments, or another one in its place.
#[cfg(feature = "view")]
async fn load(args: &ViewArgs, other: Option<&str>) -> Result<super::load::Loaded, Failure> {
    use super::args::{BackendChoice, DeviceArgs, SceneArgs};
    let scene = SceneArgs {
        scene: other.unwrap_or(&args.scene).to_owned(),
        steps: None,
        until: None,
        // Values are those of the scene that was named with them.
        overrides: if other.is_some_and(|other| other != args.scene) { Vec::new() } else { args.overrides.clone() },
        scale: if other.is_some_and(|other| other != args.scene) { None } else { args.scale },
        allow_outside: args.allow_outside,
        auto_substeps: false,
        device: DeviceArgs { backend: BackendChoice::Gpu, adapter: args.adapter.clone() },
    };
    super::load::load(&scene, &[]).await
}
