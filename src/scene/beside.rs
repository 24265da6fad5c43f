//! A scene with a file that was put beside it: particles in the place of its own, a floor plan in the place of its own, or a law.

use std::path::Path;

use toml_edit::{Array, ArrayOfTables, DocumentMut, InlineTable, Item, Table, Value, value};

use super::Source;
use super::files::LONGEST_SHADER;
use crate::error::Error;
use crate::formats;
use crate::kernel;

/// Extensions of floor plans.
const PLANS: [&str; 5] = ["wkt", "geojson", "svg", "dxf", "png"];

/// What a file can be for a scene, by its extension.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Beside {
    /// A force in WGSL.
    Law,
    /// Particles, in a format that is read.
    Particles,
    /// A floor plan.
    Plan,
}

impl Beside {
    /// That of a file; nothing where it is of another kind.
    #[must_use]
    pub fn of(name: &str) -> Option<Self> {
        let path = Path::new(name);
        let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_ascii_lowercase();
        if ending == "wgsl" {
            Some(Self::Law)
        } else if PLANS.contains(&ending.as_str()) {
            Some(Self::Plan)
        } else {
            formats::by_ending(path).filter(|format| format.read.is_some()).map(|_| Self::Particles)
        }
    }
}

/// The text of a scene in which a file has a part, by its extension: a file of particles takes the place of all of its `[[particles]]`, a floor plan that of its
/// `[plan]`, and a WGSL file becomes one more `[[force]]`, called as its functions are (`law` is its text; of others it is not needed). The rest stays as it
/// was written. A scene that names the file already stays as it is.
///
/// # Errors
/// [`Error::Scene`] when the file is of another kind, the scene is no TOML, or it has no floor plan.
pub fn with_file(text: &str, name: &str, law: &str) -> Result<String, Error> {
    let plain = |name: &str| name.trim_start_matches("./").to_owned();
    with(text, name, law, &|known| plain(known) == plain(name))
}

/// The same, where `is_it` says whether a name in the scene is that of the file.
fn with(text: &str, name: &str, law: &str, is_it: &dyn Fn(&str) -> bool) -> Result<String, Error> {
    let mut scene: DocumentMut = text.parse().map_err(|why: toml_edit::TomlError| {
        Error::Scene(format!("the scene cannot be read: {}", why.message().replace('\n', ", ")))
    })?;
    // Names are texts of the scene itself, and not of its comments.
    if text.parse::<toml::Table>().is_ok_and(|scene| names(&toml::Value::Table(scene), is_it)) {
        return Ok(text.to_owned());
    }
    match Beside::of(name) {
        Some(Beside::Law) => add(&mut scene, name, kernel::over(law))?,
        Some(Beside::Particles) => replace(&mut scene, name),
        Some(Beside::Plan) => draw(&mut scene, name)?,
        None => {
            let formats = formats::FORMATS.iter().filter(|format| format.read.is_some());
            let known: Vec<String> =
                formats.flat_map(|format| format.endings).map(|ending| format!(".{ending}")).collect();
            return Err(Error::Scene(format!(
                "{name} is neither a scene (.toml), nor a law (.wgsl), nor particles ({}), nor a floor plan (.{}): rename it, or name it in a scene",
                known.join(", "),
                PLANS.join(", .")
            )));
        }
    }
    Ok(scene.to_string())
}

/// Whether a value is such a text, or has one in it.
fn names(value: &toml::Value, is_it: &dyn Fn(&str) -> bool) -> bool {
    match value {
        toml::Value::String(text) => is_it(text),
        toml::Value::Array(all) => all.iter().any(|one| names(one, is_it)),
        toml::Value::Table(all) => all.values().any(|one| names(one, is_it)),
        _ => false,
    }
}

/// One more force.
fn add(scene: &mut DocumentMut, name: &str, over: &str) -> Result<(), Error> {
    let pairs = [("wgsl", name), ("over", over)];
    match scene.entry("force").or_insert_with(|| Item::ArrayOfTables(ArrayOfTables::new())) {
        Item::ArrayOfTables(all) => {
            let mut entry = Table::from_iter(pairs);
            entry.decor_mut().set_prefix("\n");
            all.push(entry);
            Ok(())
        }
        Item::Value(Value::Array(all)) => {
            all.push(InlineTable::from_iter(pairs));
            Ok(())
        }
        _ => Err(Error::Scene("its `force` is no list of forces: write each as `[[force]]`".to_owned())),
    }
}

/// Particles of a file alone, where the first ones stood.
fn replace(scene: &mut DocumentMut, name: &str) {
    let entry = Table::from_iter([("file", name)]);
    match scene.get_mut("particles") {
        Some(Item::ArrayOfTables(all)) => {
            let first = all.iter().next().map(|first| (first.position(), first.decor().clone()));
            let mut entry = entry;
            if let Some((position, decor)) = first {
                entry.set_position(position);
                *entry.decor_mut() = decor;
            }
            all.clear();
            all.push(entry);
        }
        Some(Item::Value(list)) => *list = Value::Array(Array::from_iter([entry.into_inline_table()])),
        _ => {
            let mut entry = entry;
            entry.decor_mut().set_prefix("\n");
            scene.insert("particles", Item::ArrayOfTables(ArrayOfTables::from_iter([entry])));
        }
    }
}

/// The plan of a file, with the names of exits and the scale that it has itself.
fn draw(scene: &mut DocumentMut, name: &str) -> Result<(), Error> {
    let Some(plan) = scene.get_mut("plan").and_then(Item::as_table_like_mut) else {
        return Err(Error::Scene(format!(
            "the scene has no floor plan that {name} could replace: write `[plan]` with `file = \"{name}\"` into it, and forces such as `social_force`"
        )));
    };
    for key in ["wkt", "exits", "scale", "pixel"] {
        plan.remove(key);
    }
    plan.insert("file", value(name));
    Ok(())
}

/// The text of a law, which is no longer than a scene may name.
fn law(name: &str) -> Result<String, Error> {
    let bad = |why: String| Error::Scene(format!("cannot read {name}: {why}"));
    let found = std::fs::metadata(name).map_err(|why| bad(why.to_string()))?;
    if !found.is_file() {
        return Err(bad("it is no regular file".to_owned()));
    }
    if found.len() > LONGEST_SHADER {
        return Err(bad(format!("{} bytes are more than the {LONGEST_SHADER} that a shader may have", found.len())));
    }
    std::fs::read_to_string(name).map_err(|why| bad(why.to_string()))
}

impl Source {
    /// The same scene [with a file](with_file) that was put beside it.
    ///
    /// # Errors
    /// As for [`with_file`], and when the scene or the law cannot be read.
    pub fn beside(&self, name: &str) -> Result<Self, Error> {
        let opened = self.open().map_err(|faults| Error::Scene(faults.to_string()))?;
        let law = if Beside::of(name) == Some(Beside::Law) { law(name)? } else { String::new() };
        let found = std::fs::canonicalize(name).ok();
        let folder = opened.folder.clone().unwrap_or_default();
        let is_it = |known: &str| {
            let path = folder.join(known);
            known == name || found.is_some() && path.is_file() && std::fs::canonicalize(path).ok() == found
        };
        let text = with(&opened.text, name, &law, &is_it)?;
        let name = format!("{}.toml", opened.name);
        Ok(match opened.folder {
            Some(folder) if opened.embedded.is_empty() => Self::Text { name, text, folder },
            _ => Self::Memory { name, text, files: opened.embedded },
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAW: &str = "// fn force(\nfn gather (me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {}";
    const SCENE: &str = "# Two of them.\n#\n# They meet.\n\n# Here: not a [[force]].\n[simulation]\ndt = 0.01 # short\nsteps = 10\n\n[[particles]]\nshape = \"plummer\"\ncount = 10\n\n[[particles]]\nshape = \"disk\"\n\n# Newton's.\n[[force]]\nkind = \"gravity\"\n";

    fn parsed(text: &str) -> toml::Table {
        text.parse().unwrap_or_else(|why| panic!("{why}: {text}"))
    }

    #[test]
    fn particles_take_the_place_of_all_and_the_rest_stays() {
        for name in ["a.csv", "b b.NPZ", "c\".tipsy", "snap.hdf5", "d\\é.csv"] {
            let text = with_file(SCENE, name, "").expect("a scene");
            let scene = parsed(&text);
            let particles = scene["particles"].as_array().expect("a list");
            assert_eq!((particles.len(), particles[0]["file"].as_str()), (1, Some(name)));
            assert_eq!(particles[0].as_table().map(toml::Table::len), Some(1));
            let (before, after) = SCENE.split_once("[[particles]]").expect("two parts");
            let after = after.rsplit_once("\n\n# Newton").expect("two parts").1;
            assert!(text.starts_with(before) && text.ends_with(after), "what was written stays: {text}");
        }
        for other in ["a = 1\n", "particles = [{ shape = \"disk\" }, { shape = \"disk\" }]\n"] {
            let text = with_file(other, "a.csv", "").expect("a scene");
            let particles = parsed(&text)["particles"].as_array().expect("a list").clone();
            assert_eq!((particles.len(), particles[0]["file"].as_str()), (1, Some("a.csv")), "{text}");
        }
    }
    #[test]
    fn a_law_is_one_more_force_and_once() {
        let text = with_file(SCENE, "my law.wgsl", LAW).expect("a scene");
        assert!(text.starts_with(SCENE), "what was written stays: {text}");
        let forces = |text: &str| parsed(text)["force"].as_array().expect("a list").clone();
        let found = |text: &str| {
            let last = forces(text).last().expect("a force").clone();
            [&last["wgsl"], &last["over"]].map(|word| word.as_str().expect("a word").to_owned())
        };
        assert_eq!((forces(&text).len(), found(&text)), (2, ["my law.wgsl", "pairs"].map(str::to_owned)));
        assert_eq!(with_file(&text, "my law.wgsl", LAW).expect("a scene"), text);
        let single = "fn force(me: Particle) -> vec4f { return vec4f(); }";
        let none = SCENE.split("# Newton").next().expect("a part");
        assert_eq!(found(&with_file(none, "a.wgsl", single).expect("a scene"))[1], "each");
        let inline = "force = [{ kind = \"gravity\" }] # [[force]]\n";
        let text = with_file(inline, "a.wgsl", single).expect("a scene");
        assert_eq!((forces(&text).len(), &*found(&text)[0]), (2, "a.wgsl"), "{text}");
        assert_eq!(with_file(&text, "a.wgsl", single).expect("a scene"), text);
    }
    #[test]
    fn a_floor_plan_takes_the_place_of_another() {
        let room = "[plan] # here\nwkt = \"POLYGON ((0 0, 1 0, 1 1, 0 0))\"\nexits = [\"door\"]\norigin = [1, 2, 0]\n\n[box]\nsize = 1\n";
        let text = with_file(room, "house.SVG", "").expect("a scene");
        assert_eq!(text, "[plan] # here\norigin = [1, 2, 0]\nfile = \"house.SVG\"\n\n[box]\nsize = 1\n");
        assert!(with_file(SCENE, "house.dxf", "").expect_err("no plan").to_string().contains("[plan]"));
    }
    #[test]
    fn what_is_not_known_is_refused() {
        let said = |text: &str, name: &str| with_file(text, name, "").expect_err("no").to_string();
        assert!(said(SCENE, "a.docx").contains(".csv") && said(SCENE, "noname").contains(".toml"));
        assert!(said("a = [", "a.csv").contains("cannot be read"), "{}", said("a = [", "a.csv"));
        assert!(said("force = 3", "a.wgsl").contains("[[force]]"));
    }
    #[test]
    fn a_law_is_a_regular_file_and_no_longer_than_one() {
        let folder = tempfile::tempdir().expect("a folder");
        let said = |name: &str, make: &dyn Fn(&Path)| {
            let path = folder.path().join(name);
            make(&path);
            let scene = Source::Text { name: "a.toml".into(), text: SCENE.into(), folder: folder.path().into() };
            scene.beside(&path.to_string_lossy()).map(|_| ()).map_err(|why| why.to_string())
        };
        let named = Source::Text {
            name: "a.toml".into(),
            text: "# \"other.wgsl\"\n[[force]]\nwgsl = \"./law.wgsl\"\nover = \"each\"\n".into(),
            folder: folder.path().into(),
        };
        for (name, forces) in [("law.wgsl", 1), ("other.wgsl", 2)] {
            let path = folder.path().join(name);
            std::fs::write(&path, LAW).expect("a file");
            let Ok(Source::Text { text, .. }) = named.beside(&path.to_string_lossy()) else { panic!("a text") };
            assert_eq!(parsed(&text)["force"].as_array().map(Vec::len), Some(forces), "{text}");
        }
        assert!(said("law.wgsl", &|path| std::fs::write(path, LAW).expect("a file")).is_ok());
        let folder = said("folder.wgsl", &|path| std::fs::create_dir(path).expect("a folder"));
        assert!(folder.expect_err("a folder").contains("no regular file"));
        let long = said("long.wgsl", &|path| {
            std::fs::File::create(path).and_then(|file| file.set_len(LONGEST_SHADER + 1)).expect("a file");
        });
        assert!(long.expect_err("a long one").contains("1048577 bytes"));
    }
}
