//! `motes scenes`

use motes::scene::{SCENES, SECTIONS, Source};
use motes::settings::{Key, Kind, Value};

use super::args::ScenesArgs;
use super::failure::Failure;

/// Lists the scenes, or prints one.
pub fn scenes(args: &ScenesArgs) -> Result<(), Failure> {
    if args.keys {
        return keys(args.name.as_deref());
    }
    let Some(name) = &args.name else {
        let wide = SCENES.iter().map(|scene| scene.name.len()).max().unwrap_or(0);
        for scene in SCENES {
            let about = scene.about();
            out!("{:wide$} {}", scene.name, first_sentence(&about));
        }
        out!(
            "\nmotes run NAME runs one; motes scenes NAME prints it, to be saved and changed;\nmotes scenes --keys prints every key of a scene."
        );
        return Ok(());
    };
    match Source::find(name)? {
        Source::Builtin(scene) => out!("{}", scene.text.trim_end()),
        Source::File(path) => {
            return Err(motes::Error::Scene(format!("{} is a file, not a built-in scene", path.display())).into());
        }
        Source::Text { .. } => {}
    }
    Ok(())
}

/// Every key that a scene may give, or those of one thing.
fn keys(wanted: Option<&str>) -> Result<(), Failure> {
    let forces = motes::forces::entries().map(|e| ("[[force]] kind", e.name, e.about, e.keys));
    let shapes = motes::shapes::SHAPES.iter().map(|e| ("[[particles]] shape", e.name, e.about, e.keys));
    let measures = motes::measure::MEASURES.iter().map(|e| ("[[measure]] kind", e.name, e.about, e.keys));
    let entries = forces.chain(shapes).chain(measures).filter(|entry| wanted.is_none_or(|name| name == entry.1));
    let sections = || SECTIONS.iter().filter(|section| wanted.is_none_or(|name| name == section.name));
    let all: Vec<_> = entries.collect();
    if all.is_empty() && sections().next().is_none() {
        let text = format!(
            "no force, shape, measure or section is called `{}`; motes scenes --keys lists all",
            wanted.unwrap_or_default()
        );
        return Err(motes::Error::Scene(text).into());
    }
    for (place, name, about, keys) in all {
        out!("{place} = \"{name}\": {about}");
        list(keys);
        out!("");
    }
    for section in sections() {
        out!("section = \"{}\": {}", section.name, section.about);
        for own in section.own {
            out!("    {:16} {:20} {}", own.name, own.default, own.about);
        }
        list(section.keys);
        out!("");
    }
    Ok(())
}

fn list(keys: &[Key]) {
    for key in keys {
        let default = key.default.as_ref().map_or_else(|| "must be given".to_owned(), shown);
        out!("    {:16} {default:20} {}", key.name, key.about);
        if let Kind::Pairs(keys) = key.kind {
            list(keys);
        }
    }
}

fn shown(value: &Value) -> String {
    match value {
        Value::Number(x) => x.to_string(),
        Value::Vector(v) => format!("[{}, {}, {}]", v.x, v.y, v.z),
        Value::Text(t) => format!("\"{t}\""),
        Value::Flag(f) => f.to_string(),
        Value::Pairs(rows) => format!("{} pairs", rows.len()),
    }
}

fn first_sentence(about: &str) -> String {
    let flat = about.lines().take_while(|l| !l.trim().is_empty()).collect::<Vec<_>>().join(" ");
    flat.split_inclusive(". ").next().unwrap_or_default().trim().to_owned()
}
