//! The folder of results: nothing is lost in it that was not asked for, and no two runs mix.

use std::path::Path;
use std::time::{Duration, Instant};

use crate::process::{Place, Running, SCENE, motes, output};

const RESULTS: [&str; 6] =
    ["energy.csv", "energy.svg", "scene.toml", "snapshot_00.csv", "snapshot_10.csv", "snapshot_20.csv"];

#[test]
fn a_scene_in_the_folder_is_not_replaced() {
    let place = Place::with(&[("scene.toml", SCENE)]);
    for more in [&[][..], &["--overwrite"], &["-q"]] {
        let (code, _, stderr) = place.run("scene.toml", "", more);
        assert_eq!(code, 8, "{stderr}");
        assert!(stderr.contains("scene.toml") && stderr.contains("this run reads the file"), "{stderr}");
    }
    assert_eq!(place.text("scene.toml"), SCENE);
    assert_eq!(place.names(""), ["scene.toml"], "nothing is written");
    // Under another name it may lie there.
    place.put("orbit.toml", SCENE);
    std::fs::remove_file(place.at("scene.toml")).expect("removed");
    let (code, _, stderr) = place.run("orbit.toml", "", &[]);
    assert_eq!(code, 0, "{stderr}");
    assert_eq!(place.text("orbit.toml"), SCENE);
    // Now it is a result, and so may be replaced, but not while it is read.
    let (code, _, stderr) = place.run("scene.toml", "", &["--overwrite"]);
    assert!(code == 8 && stderr.contains("this run reads the file"), "{stderr}");
    assert_eq!(place.run("orbit.toml", "", &["--overwrite"]).0, 0);
}

#[test]
fn a_file_of_particles_is_not_replaced() {
    let table = "x,y,z\n1,2,3\n4,5,6\n";
    let scene =
        "[simulation]\ndt = 0.1\nsteps = 2\n[[particles]]\nfile = \"snapshot_0.csv\"\n[output]\nformats = [\"csv\"]\n";
    let place = Place::with(&[("a.toml", scene), ("snapshot_0.csv", table)]);
    let (code, _, stderr) = place.run("a.toml", "", &["--overwrite"]);
    assert!(code == 8 && stderr.contains("snapshot_0.csv") && stderr.contains("reads the file"), "{stderr}");
    assert_eq!(place.text("snapshot_0.csv"), table);
    // Nor is one that no run has written, even where it is not read.
    place.put("b.toml", SCENE);
    for more in [&[][..], &["--overwrite"]] {
        let (code, _, stderr) = place.run("b.toml", "", more);
        assert!(code == 8 && stderr.contains("no scene.toml of a run"), "{stderr}");
    }
    assert_eq!(place.names(""), ["a.toml", "b.toml", "snapshot_0.csv"]);
}

#[test]
fn results_of_another_run_are_removed_when_that_is_asked_for() {
    let place = Place::with(&[("first.toml", SCENE), ("second.toml", SCENE)]);
    let picture = ["--set", "output.formats=[\"csv\", \"npz\", \"png\"]", "--set", "picture.width=32"];
    let more = [&picture[..], &["--set", "picture.height=32", "--frames", "2"]].concat();
    let (code, _, stderr) = place.run("first.toml", "out", &more);
    assert_eq!(code, 0, "{stderr}");
    place.put("out/notes.txt", "mine");
    place.put("out/photo.png", "mine");
    let before = place.names("out");
    assert!(before.contains(&"first.png".to_owned()) && before.contains(&"first_film.png".to_owned()), "{before:?}");
    let (code, _, stderr) = place.run("second.toml", "out", &["-q"]);
    assert_eq!(code, 8);
    assert!(stderr.contains("results of another run") && stderr.contains("--overwrite"), "{stderr}");
    assert_eq!(place.names("out"), before, "a refusal changes nothing");
    let (code, _, stderr) = place.run("second.toml", "out", &["--overwrite"]);
    assert_eq!(code, 0, "{stderr}");
    let mut expected: Vec<_> = RESULTS.to_vec();
    expected.extend(["frames", "notes.txt", "photo.png"]);
    expected.sort_unstable();
    assert_eq!(place.names("out"), expected, "the user's files stay, and of the first run nothing");
    assert!(place.names("out/frames").is_empty());
}

/// A run that continues for minutes, unless it is ended.
fn long(place: &Place) -> Running {
    let (scene, out) = (place.at("a.toml"), place.at("out"));
    let mut command = motes(&["run", &scene, "-o", &out, "--backend", "cpu", "--steps", "200000000", "-q"]);
    let child = Running(command.spawn().expect("the program starts"));
    let start = Instant::now();
    while !Path::new(&out).join("snapshot_000000000.csv").exists() {
        assert!(start.elapsed() < Duration::from_mins(1), "the run does not begin");
        std::thread::sleep(Duration::from_millis(20));
    }
    child
}

#[test]
fn a_second_run_into_the_folder_is_refused() {
    let place = Place::with(&[("a.toml", SCENE), ("b.toml", SCENE)]);
    let mut child = long(&place);
    for more in [&["--overwrite"][..], &["--overwrite", "-q"]] {
        let (code, _, stderr) = place.run("b.toml", "out", more);
        assert!(code == 8 && stderr.contains("another run writes into this folder"), "{stderr}");
    }
    child.0.kill().expect("killed");
    child.0.wait().expect("it ends");
    // What a killed run has left half written goes with its results.
    place.put("out/.motes-abc123.part", "half");
    let (code, _, stderr) = place.run("b.toml", "out", &["--overwrite"]);
    assert_eq!(code, 0, "{stderr}");
    assert_eq!(place.names("out"), RESULTS, "no lock and nothing of the killed run is left");
}

#[test]
fn what_was_left_half_written_goes_where_nothing_else_is() {
    let place = Place::with(&[("a.toml", SCENE)]);
    std::fs::create_dir_all(place.at("out/frames")).expect("a folder");
    for name in ["out/.motes-1.part", "out/frames/.motes-2.part", "out/other.part"] {
        place.put(name, "half");
    }
    assert_eq!(place.run("a.toml", "out", &[]).0, 0);
    assert!(place.names("out/frames").is_empty());
    assert!(place.names("out").iter().all(|name| !name.starts_with(".motes")), "{:?}", place.names("out"));
    assert_eq!(place.text("out/other.part"), "half");
}

#[cfg(unix)]
#[test]
fn links_are_not_followed() {
    use std::os::unix::fs::symlink;
    let place = Place::with(&[("a.toml", SCENE), ("victim", "precious")]);
    for name in ["energy.csv", "snapshot_10.csv", "scene.toml", "energy.svg"] {
        std::fs::create_dir_all(place.at("out")).expect("a folder");
        symlink(place.at("victim"), place.at(&format!("out/{name}"))).expect("a link");
        let (code, _, stderr) = place.run("a.toml", "out", &["--overwrite"]);
        assert!(code == 8 && stderr.contains(name), "{name}: {stderr}");
        std::fs::remove_dir_all(place.at("out")).expect("removed");
    }
    // Beside results of a run the link itself is removed.
    assert_eq!(place.run("a.toml", "out", &[]).0, 0);
    std::fs::remove_file(place.at("out/energy.csv")).expect("removed");
    symlink(place.at("victim"), place.at("out/energy.csv")).expect("a link");
    assert_eq!(place.run("a.toml", "out", &["--overwrite"]).0, 0);
    assert!(!Path::new(&place.at("out/energy.csv")).is_symlink());
    // Nor is the folder of a film a link.
    std::fs::remove_dir_all(place.at("out")).expect("removed");
    std::fs::create_dir_all(place.at("out")).expect("a folder");
    std::fs::create_dir_all(place.at("elsewhere")).expect("a folder");
    symlink(place.at("elsewhere"), place.at("out/frames")).expect("a link");
    let (code, _, stderr) = place.run("a.toml", "out", &["--frames", "2"]);
    assert!(code == 8 && stderr.contains("frames is a link"), "{stderr}");
    assert_eq!(place.text("victim"), "precious");
}

#[test]
fn the_resolved_scene_tells_nothing_of_where_it_was_run() {
    let scene = "[simulation]\ndt = 0.1\nsteps = 2\n[[particles]]\nfile = \"bodies.csv\"\n[[force]]\nwgsl = \"pull.wgsl\"\nover = \"each\"\n";
    let law = "fn force(me: Particle) -> vec4f { return vec4f(-me.position, 0.0); }\n";
    let place = Place::with(&[("a.toml", scene), ("bodies.csv", "x,y,z\n1,2,3\n"), ("pull.wgsl", law)]);
    let (scene, out) = (place.at("a.toml"), place.at("results/of/a"));
    let few = ["--set", "output.formats=[\"csv\"]"];
    let (code, _, stderr) = output(&mut motes(&[&["run", &scene, "-o", &out][..], &few].concat()));
    assert_eq!(code, 0, "{stderr}");
    let resolved = place.text("results/of/a/scene.toml");
    for line in ["file = \"../../../bodies.csv\"", "wgsl = \"../../../pull.wgsl\""] {
        assert!(resolved.contains(line), "{resolved}");
    }
    let root = place.0.path().canonicalize().expect("a path");
    assert!(!resolved.contains(root.to_str().expect("words")), "{resolved}");
    let (resolved, again) = (format!("{out}/scene.toml"), place.at("again"));
    let again = [&["run", &resolved, "-o", &again, "--allow-outside"][..], &few].concat();
    let (code, _, stderr) = output(&mut motes(&again));
    assert_eq!(code, 0, "{stderr}");
    assert_eq!(place.text("results/of/a/snapshot_2.csv"), place.text("again/snapshot_2.csv"));
}

#[test]
fn a_scene_called_by_dots_has_a_folder() {
    let place = Place::with(&[("..toml", SCENE)]);
    let mut command = motes(&["run", "..toml", "--backend", "cpu", "-q"]);
    let (code, _, stderr) = output(command.current_dir(place.0.path()));
    assert_eq!((code, stderr.as_str()), (0, ""));
    assert_eq!(place.names("out"), ["scene"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_pipe_with_a_name_is_no_scene() {
    let place = Place::with(&[]);
    let pipe = place.at("pipe.toml");
    assert!(std::process::Command::new("mkfifo").arg(&pipe).status().expect("mkfifo").success());
    let start = Instant::now();
    let mut child = motes(&["check", &pipe]).stderr(std::process::Stdio::piped()).spawn().expect("the program starts");
    while child.try_wait().expect("a status").is_none() {
        if start.elapsed() > Duration::from_secs(20) {
            child.kill().expect("killed");
            panic!("it waits for ever");
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    let output = child.wait_with_output().expect("it ends");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(3) && stderr.contains("is a pipe"), "{stderr}");
    // One that another process fills has no name, and is read.
    let shell = format!("\"$0\" check <(printf '%s' '{}') --backend cpu", SCENE.replace('\'', ""));
    let mut command = std::process::Command::new("bash");
    let (code, _, stderr) = crate::process::output(command.args(["-c", &shell, env!("CARGO_BIN_EXE_motes")]));
    assert_eq!(code, 0, "{stderr}");
}

/// Every format of the register is written by a run, replaced by the next, and read as where another run begins.
#[test]
fn every_format_is_written_replaced_and_read() {
    for format in motes::formats::FORMATS.iter().filter(|format| format.write.is_some()) {
        let scene = SCENE.replace("formats = [\"csv\"]", &format!("formats = [\"{}\"]", format.name));
        assert_eq!(format.name == "csv", scene == SCENE, "the scene says which format");
        let place = Place::with(&[("a.toml", &scene)]);
        assert_eq!(place.run("a.toml", "out", &[]).0, 0, "{}", format.name);
        let last = format!("out/snapshot_20.{}", format.name);
        assert!(Path::new(&place.at(&last)).exists(), "{last}");
        let (code, _, stderr) = place.run("a.toml", "out", &["--overwrite"]);
        assert_eq!(code, 0, "{stderr}");
        let next =
            format!("[simulation]\ndt = 0.1\nsteps = 1\n[[particles]]\nfile = \"{last}\"\n[output]\nformats = []\n");
        place.put("b.toml", &next);
        let (code, _, stderr) = place.run("b.toml", "next", &[]);
        assert_eq!(code, 0, "{}: {stderr}", format.name);
    }
}

/// A state in several files, compressed: all are results, a later run reads them by any name, and nothing is left of them.
#[test]
fn a_state_is_divided_and_compressed() {
    let scene = SCENE.replace("formats = [\"csv\"]", "formats = [\"hdf5\", \"npz\"]\nfiles = 3\ncompress = true");
    let place = Place::with(&[("a.toml", &scene), ("plain.toml", &scene.replace("files = 3\ncompress = true", ""))]);
    assert_eq!(place.run("a.toml", "out", &[]).0, 0);
    for part in 0..3 {
        assert!(Path::new(&place.at(&format!("out/snapshot_20.{part}.hdf5"))).exists(), "{:?}", place.names("out"));
    }
    assert!(!Path::new(&place.at("out/snapshot_20.hdf5")).exists());
    // The numbers are those of one file.
    assert_eq!(place.run("plain.toml", "plain", &[]).0, 0);
    let state = |file: &str| {
        let columns = motes::kernel::Columns::default();
        let state = motes::formats::read(Path::new(&place.at(file)), &columns).expect(file);
        state.columns().map(|(column, values)| (column.name.to_string(), values.clone())).collect::<Vec<_>>()
    };
    let whole = state("plain/snapshot_20.hdf5");
    for file in ["out/snapshot_20.0.hdf5", "out/snapshot_20.2.hdf5", "out/snapshot_20.npz"] {
        assert_eq!(state(file), whole, "{file}");
    }
    // Without a word they stay, with it none is left beside the new ones.
    assert_eq!(place.run("plain.toml", "out", &[]).0, 8);
    assert_eq!(place.run("plain.toml", "out", &["--overwrite"]).0, 0);
    let left = place.names("out");
    assert!(!left.iter().any(|name| name.contains(".0.hdf5")), "{left:?}");
}

#[test]
fn what_no_format_does_is_not_asked_of_it() {
    for (more, words) in [
        ("files = 3", "it is for hdf5"),
        ("compress = true", "it is for npz, hdf5, vtp"),
        ("files = 0", "files"),
        ("files = 5000", "at most 4096"),
    ] {
        let formats = if more == "files = 5000" { "hdf5" } else { "csv" };
        let scene = SCENE.replace("formats = [\"csv\"]", &format!("formats = [\"{formats}\"]\n{more}"));
        let place = Place::with(&[("a.toml", &scene)]);
        let (code, _, stderr) = place.run("a.toml", "out", &[]);
        assert!(code == 2 || code == 3, "{more}: {code} {stderr}");
        assert!(stderr.contains(words), "{more}: {stderr}");
    }
}
