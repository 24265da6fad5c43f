//! `motes scenes`

use motes::scene::{SCENES, Source};

use super::args::ScenesArgs;
use super::failure::Failure;

/// Lists the scenes, or prints one.
pub fn scenes(args: &ScenesArgs) -> Result<(), Failure> {
    let Some(name) = &args.name else {
        for scene in SCENES {
            let about = scene.about();
            out!("{:14} {}", scene.name, first_sentence(&about));
        }
        out!("\nmotes run NAME runs one; motes scenes NAME prints it, to be saved and changed.");
        return Ok(());
    };
    match Source::find(name)? {
        Source::Builtin(scene) => out!("{}", scene.text.trim_end()),
        Source::File(path) => {
            return Err(
                motes::Error::Scene(format!("{} is a file of yours, not a scene of motes", path.display())).into()
            );
        }
        Source::Text { .. } => {}
    }
    Ok(())
}

fn first_sentence(about: &str) -> String {
    let flat = about.lines().take_while(|l| !l.trim().is_empty()).collect::<Vec<_>>().join(" ");
    flat.split_inclusive(". ").next().unwrap_or_default().trim().to_owned()
}
