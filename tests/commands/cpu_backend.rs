//! The CPU backend runs what the command comes with: every built-in scene, with files and pictures.

use std::process::{Command, Stdio};

use crate::support::small::SMALLER;
use motes::scene::SCENES;

fn run(scene: &str, out: &str, more: &[&str]) -> (Option<i32>, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
    command.args(["run", scene, "--backend", "cpu", "--steps", "3", "-o", out]).stdin(Stdio::null());
    let small = ["output.every=1", "output.formats=[\"csv\", \"png\"]", "picture.width=48", "picture.height=32"];
    for set in small.iter().chain(more) {
        command.args(["--set", set]);
    }
    let output = command.output().expect("the program starts");
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

/// Each step comes after a picture, and may use nothing that the picture left on the host.
#[test]
fn every_built_in_scene_runs_with_pictures() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, _) in SMALLER {
        assert!(SCENES.iter().any(|scene| scene.name == *name), "there is no scene {name}");
    }
    let mut failed = Vec::new();
    for scene in SCENES {
        let smaller = SMALLER.iter().find(|(name, _)| *name == scene.name).map_or(&[][..], |(_, sets)| sets);
        let out = folder.path().join(scene.name);
        let (code, stderr) = run(scene.name, out.to_str().expect("a path of words"), smaller);
        let pictures = ["picture_0.png", "picture_3.png"].iter().all(|name| out.join(name).exists());
        if code != Some(0) || !pictures {
            failed.push(format!("{}: exit {code:?}\n{stderr}", scene.name));
        }
    }
    assert!(failed.is_empty(), "{}", failed.join("\n"));
}

/// Springs of one kind, springs that break, rods and joints: what a picture of them leaves on the host changes no step.
#[test]
fn pictures_do_not_change_what_springs_do() {
    let folder = tempfile::tempdir().expect("a folder");
    for (scene, sizes) in [
        ("cloth", crate::support::small::smaller("cloth")),
        ("tear", crate::support::small::smaller("tear")),
        ("spring_chain", &[]),
    ] {
        let [with, without] = ["with", "without"].map(|name| folder.path().join(format!("{scene}_{name}")));
        for (out, formats) in [(&with, "[\"csv\", \"png\"]"), (&without, "[\"csv\"]")] {
            let formats = format!("output.formats={formats}");
            let sets = [sizes, &[formats.as_str()]].concat();
            let (code, stderr) = run(scene, out.to_str().expect("a path of words"), &sets);
            assert_eq!(code, Some(0), "{scene}: {stderr}");
        }
        let [with, without] = [with, without].map(|out| std::fs::read(out.join("snapshot_3.csv")).expect("a snapshot"));
        assert!(with == without, "{scene}: pictures changed the run");
    }
}

/// Pictures by the references may take longer than all steps: `check` says how long.
#[test]
fn the_time_of_pictures_is_forecast() {
    let said = |backend: &str, sets: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_motes"));
        command.args(["check", "kepler", "--backend", backend, "--steps", "100", "--set", "picture.width=64"]);
        command.args(["--set", "picture.height=48", "--set", "output.every=10"]);
        sets.iter().for_each(|set| {
            command.args(["--set", set]);
        });
        let output = command.output().expect("the program starts");
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        String::from_utf8_lossy(&output.stdout).into_owned()
    };
    let drawn = ["output.formats=[\"png\"]", "output.frames=7"];
    let both = said("cpu", &drawn);
    assert!(both.contains("without files and pictures\npictures: 18 of 64×48, "), "{both}");
    let none = said("cpu", &["output.formats=[\"csv\"]", "output.frames=0"]);
    assert!(none.contains("without files\n") && !none.contains("pictures:"), "{none}");
    let device = said("gpu", &drawn);
    assert!(device.contains("without files and pictures\n") && !device.contains("pictures:"), "{device}");
}
