//! Evaluation is pure: a run that is measured, drawn and saved after each step ends with the same bits as one that is left alone.

use std::path::Path;
use std::process::{Command, Stdio};

use motes::scene::SCENES;

/// Enough for a list of neighbours, a tree and the first births to be made anew.
const STEPS: &str = "7";

fn last(scene: &str, out: &Path, more: &[&str]) -> Vec<u8> {
    let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
    command.args(["run", scene, "--backend", "gpu", "--steps", STEPS, "-q", "-o"]).arg(out).stdin(Stdio::null());
    for set in crate::support::small::smaller(scene).iter().chain(more) {
        command.args(["--set", set]);
    }
    let output = command.output().expect("the program starts");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{scene} {more:?}: {said}");
    std::fs::read(out.join(format!("snapshot_{STEPS}.csv"))).unwrap_or_else(|error| panic!("{scene}: {error}"))
}

#[test]
fn measuring_drawing_and_saving_change_no_bit() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut changed = Vec::new();
    for scene in SCENES {
        let [often, once] = ["often", "once"].map(|name| folder.path().join(format!("{}_{name}", scene.name)));
        let watched =
            ["output.every=1", "output.formats=[\"csv\", \"png\", \"npz\"]", "picture.width=48", "picture.height=32"];
        let watched = last(scene.name, &often, &watched);
        let alone = last(scene.name, &once, &["output.every=7", "output.formats=[\"csv\"]"]);
        assert!(watched.len() > 40, "{}: a snapshot holds particles", scene.name);
        if watched != alone {
            changed.push(scene.name);
        }
    }
    assert!(changed.is_empty(), "watching changed the bits of {changed:?}");
}
