//! `motes scenes`

use motes::scene::{BOX_KEYS, LINKS_KEYS, MOTION_KEYS, PARTICLES_KEYS, SCENES, SOLVER_KEYS, Source};
use motes::settings::Value;

use super::args::ScenesArgs;
use super::failure::Failure;

/// Lists the scenes, or prints one.
pub fn scenes(args: &ScenesArgs) -> Result<(), Failure> {
    if args.keys {
        return keys(args.name.as_deref());
    }
    let Some(name) = &args.name else {
        for scene in SCENES {
            let about = scene.about();
            out!("{:14} {}", scene.name, first_sentence(&about));
        }
        out!(
            "\nmotes run NAME runs one; motes scenes NAME prints it, to be saved and changed;\nmotes scenes --keys prints all that a scene may say."
        );
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

/// Every key that a scene may give, or those of one thing.
fn keys(wanted: Option<&str>) -> Result<(), Failure> {
    let forces = motes::forces::FORCES.iter().map(|e| ("[[force]] kind", e.name, e.about, e.keys));
    let shapes = motes::particles::SHAPES.iter().map(|e| ("[[particles]] shape", e.name, e.about, e.keys));
    let sections = [
        (
            "section",
            "box",
            "where particles may be; x, y and z say otherwise for single axes, dimensions 2 or 3",
            BOX_KEYS,
        ),
        ("section", "solver", "how well implicit integrators solve their equations", SOLVER_KEYS),
        (
            "section",
            "motion",
            "what leads held particles and solids: a name, and keys as in [{ time = 0 }, { time = 2, shift = [1, 0, 0], \
             turn = [0, 0, 90] }]",
            MOTION_KEYS,
        ),
        ("section", "particles", "what every [[particles]] may say", PARTICLES_KEYS),
        ("section", "links", "what ties particles: a file, or pairs of ids", LINKS_KEYS),
        ("section", "picture", "how pictures are made", motes::render::KEYS),
    ];
    let all: Vec<_> = forces.chain(shapes).chain(sections).filter(|e| wanted.is_none_or(|name| name == e.1)).collect();
    if all.is_empty() {
        let text = format!(
            "no force, shape or section is called `{}`; motes scenes --keys lists all",
            wanted.unwrap_or_default()
        );
        return Err(motes::Error::Scene(text).into());
    }
    for (place, name, about, keys) in all {
        out!("{place} = \"{name}\": {about}");
        for key in keys {
            let default = key.default.as_ref().map_or_else(|| "must be given".to_owned(), shown);
            out!("    {:16} {default:20} {}", key.name, key.about);
        }
        out!("");
    }
    Ok(())
}

fn shown(value: &Value) -> String {
    match value {
        Value::Number(x) => x.to_string(),
        Value::Vector(v) => format!("[{}, {}, {}]", v.x, v.y, v.z),
        Value::Text(t) => format!("\"{t}\""),
        Value::Flag(f) => f.to_string(),
    }
}

fn first_sentence(about: &str) -> String {
    let flat = about.lines().take_while(|l| !l.trim().is_empty()).collect::<Vec<_>>().join(" ");
    flat.split_inclusive(". ").next().unwrap_or_default().trim().to_owned()
}
