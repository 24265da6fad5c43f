//! Scenes that are wrong, and remarks on scenes that are not.

use std::fmt::Write as _;
use std::path::Path;

use motes::diagnose::{Judged, Remark, Severity, advice, of_machine, unsafe_steps};
use motes::kernel::Machine;
use motes::scene::{Options, Scene, Source};

use crate::golden::{self, Case};

/// Beginnings of scenes, which a case names by `$ NAME`.
const BEGINNINGS: &[(&str, &str)] = &[
    ("one", "[simulation]\ndt = 0.1\nsteps = 10\n[[particles]]\nbodies = [{ position = [0, 0, 0] }]\n"),
    (
        "two",
        "[simulation]\ndt = 0.01\nsteps = 10\n[[particles]]\nbodies = [{ position = [0, 0, 0], mass = 1 }, { position = [1, 0, 0], mass = 1 }]\n",
    ),
    (
        "universe",
        "[simulation]\ndt = 0.005\nuntil_redshift = 0\n[box]\nlow = [-8, -8, -8]\nsize = [16, 16, 16]\n[[particles]]\nshape = \"cosmological\"\ncount_per_side = 8\nside = 16\nmegaparsec = 1\n[[force]]\nkind = \"gravity\"\nhubble = 10\nimages = \"ewald\"\n",
    ),
    (
        "fluid",
        "[simulation]\ndt = 0.001\nsteps = 10\n[[particles]]\nshape = \"block\"\nsize = [0.5, 0.5, 0.5]\nspacing = 0.1\ndensity = 1000\n",
    ),
];

/// What a case gives to the loader.
#[derive(Default)]
struct Given {
    scene: String,
    overrides: Vec<String>,
    files: Vec<(String, String)>,
}

fn given(case: &Case) -> Given {
    let (mut given, mut file) = (Given::default(), None);
    for line in case.input.lines() {
        match line.strip_prefix("$ ").map(|words| words.split_once(' ').unwrap_or((words, ""))) {
            Some(("set", value)) => given.overrides.push(value.to_owned()),
            Some(("file", name)) => file = Some((name.to_owned(), String::new())),
            Some(("end", _)) => given.files.extend(file.take()),
            Some((name, _)) => {
                let beginning = BEGINNINGS.iter().find(|(known, _)| *known == name);
                given.scene.push_str(beginning.unwrap_or_else(|| panic!("no beginning {name}")).1);
            }
            None => {
                let text = file.as_mut().map_or(&mut given.scene, |(_, text)| text);
                let _ = writeln!(text, "{line}");
            }
        }
    }
    given
}

fn said(one: &Remark) -> String {
    let word = if one.severity == Severity::Warning { "warning" } else { "note" };
    format!("{word} ({}): {one}", one.id)
}

/// The messages of a scene that loads.
async fn remarks_on(mut scene: Scene) -> Result<String, motes::Error> {
    let mut lines: Vec<String> = scene.remarks.iter().map(|one| format!("note: {one}")).collect();
    let (steps, end) = (scene.steps, scene.steps as f64 * scene.dt);
    let setup = scene.setup();
    setup.check()?;
    let judged = Judged::of(&setup, steps).await?;
    let mut all = judged.remarks;
    all.extend(judged.verdict.and_then(|verdict| unsafe_steps(&verdict, &setup)));
    all.extend(advice(&setup, Some(end))?);
    all.extend(of_machine(&setup, Machine::HOST, true)?);
    setup.plans(Machine::HOST)?;
    lines.extend(judged.lines);
    lines.extend(motes::diagnose::forecast(&setup, end));
    lines.extend(all.iter().map(said));
    Ok(lines.join("\n"))
}

fn messages(case: &Case) -> String {
    let Given { scene, overrides, files } = given(case);
    let folder = tempfile::tempdir().expect("a folder");
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).expect("a file");
    }
    let source = Source::Text { name: "a.toml".to_owned(), text: scene, folder: folder.path().to_owned() };
    let text = match Scene::load(&source, &overrides, &Options::default()) {
        Err(faults) => faults.to_string(),
        Ok(scene) => pollster::block_on(remarks_on(scene)).unwrap_or_else(|error| format!("error: {error}")),
    };
    super::cleaned(&text, Path::new(folder.path()))
}

macro_rules! files {
    ($($name:ident),* $(,)?) => {$(
        #[test]
        fn $name() {
            golden::compare(concat!("tests/inputs/messages/", stringify!($name), ".txt"), messages);
        }
    )*};
}

files!(syntax, sections, particles, forces, own_laws, files, remarks);
