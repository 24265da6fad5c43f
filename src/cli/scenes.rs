//! `motes scenes`

use motes::scene::{SCENES, SECTIONS, Section, Source};
use motes::settings::{Key, Kind, Value as Setting};
use serde_json::{Value, json};

use super::args::ScenesArgs;
use super::failure::Failure;

/// Lists the scenes, or prints one.
pub fn scenes(args: &ScenesArgs) -> Result<(), Failure> {
    if args.keys {
        return keys(args.name.as_deref(), args.json);
    }
    let Some(name) = &args.name else {
        if args.json {
            let all: Vec<_> =
                SCENES.iter().map(|scene| json!({ "name": scene.name, "about": scene.about() })).collect();
            out!("{:#}", json!({ "scenes": all }));
            return Ok(());
        }
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
        Source::Builtin(scene) if args.json => {
            out!("{:#}", json!({ "name": scene.name, "about": scene.about(), "text": scene.text }));
        }
        Source::Builtin(scene) => out!("{}", scene.text.trim_end()),
        Source::File(path) => {
            return Err(motes::Error::Scene(format!("{} is a file, not a built-in scene", path.display())).into());
        }
        Source::Text { .. } | Source::Memory { .. } => {}
    }
    Ok(())
}

/// Prints all keys of scenes, or those of one force, shape, measure or section.
fn keys(wanted: Option<&str>, as_json: bool) -> Result<(), Failure> {
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
    if as_json {
        let entries = all.iter().map(|(place, name, about, keys)| {
            json!({ "place": place, "name": name, "about": about, "keys": keys_json(keys) })
        });
        let of_section = |section: &Section| {
            let own = section
                .own
                .iter()
                .map(|own| json!({ "name": own.name, "default_words": own.default, "about": own.about }));
            let keys: Vec<Value> = own.chain(keys_json(section.keys)).collect();
            json!({ "place": section.header(), "name": section.name, "about": section.about, "keys": keys })
        };
        let all: Vec<Value> = entries.chain(sections().map(of_section)).collect();
        out!("{:#}", json!({ "entries": all }));
        return Ok(());
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

fn keys_json(keys: &[Key]) -> Vec<Value> {
    let default = |value: &Setting| match value {
        Setting::Number(x) => json!(x),
        Setting::Vector(v) => json!(v.to_array()),
        Setting::Text(text) => json!(text),
        Setting::Flag(on) => json!(on),
        Setting::Pairs(_) => json!([]),
    };
    let one = |key: &Key| {
        let of_pairs = if let Kind::Pairs(keys) = key.kind { keys_json(keys) } else { Vec::new() };
        json!({ "name": key.name, "required": key.default.is_none(), "default": key.default.as_ref().map(default),
            "accepts": key.kind.wanted(), "about": key.about, "keys": of_pairs })
    };
    keys.iter().map(one).collect()
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

fn shown(value: &Setting) -> String {
    match value {
        Setting::Number(x) => x.to_string(),
        Setting::Vector(v) => format!("[{}, {}, {}]", v.x, v.y, v.z),
        Setting::Text(t) => format!("\"{t}\""),
        Setting::Flag(f) => f.to_string(),
        Setting::Pairs(rows) => format!("{} pairs", rows.len()),
    }
}

fn first_sentence(about: &str) -> String {
    let flat = about.lines().take_while(|l| !l.trim().is_empty()).collect::<Vec<_>>().join(" ");
    flat.split_inclusive(". ").next().unwrap_or_default().trim().to_owned()
}
