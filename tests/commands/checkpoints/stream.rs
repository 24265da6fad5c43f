//! A thread writes files while the run continues: its faults end the run, a slow disk holds it, and what comes of it are the same files.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use motes::formats::Precision;
use motes::run::{Options, Progress, Run};
use motes::scene::{self, Scene, Source};
use motes::{Cpu, Error, Simulation};
use pollster::block_on;

use crate::checkpoints::library::references;
use crate::checkpoints::{Place, SCENE, difference};

/// Three bodies, and so many outputs that they do not all wait.
fn many() -> String {
    let scene = SCENE.replace("steps = 40", "steps = 400").replace("every = 10\n", "every = 1\n");
    scene
        .replace("\"csv\", \"npz\", \"png\"", "\"csv\"")
        .replace("frames = 6", "frames = 0")
        .replace("7 steps", "390 steps")
}

/// Puts something in the way of an output when its step comes near, and says how far the run is.
struct Blocks {
    step: u64,
    put: Option<Box<dyn FnOnce() + Send>>,
    done: Arc<AtomicU64>,
}

impl Progress for Blocks {
    fn measured(&mut self, row: &motes::Energy, _: &motes::Energy) {
        self.done.store(row.step, Ordering::Relaxed);
        if row.step >= self.step {
            self.put.take().into_iter().for_each(|put| put());
        }
    }
}

/// Runs the scene by the references, with something in the way.
fn run(scene: &Path, out: PathBuf, mut blocks: Blocks) -> Result<u64, Error> {
    let source = Source::find(scene.to_str().expect("words")).unwrap_or_else(|faults| panic!("{faults}"));
    let mut scene = Scene::load(&source, &[], &scene::Options::default()).unwrap_or_else(|faults| panic!("{faults}"));
    let setup = scene.setup();
    let options = Options { device: references(), precision: Precision::Double, ..Options::into(out) };
    let mut run = Run::new(scene, &setup, options)?;
    let mut simulation = Simulation::on(Cpu::new(setup.check()?)?, &setup)?;
    block_on(run.drive(&mut simulation, &mut blocks)).map(|end| end.steps)
}

#[test]
fn a_file_that_cannot_be_written_ends_the_run_with_its_name() {
    for (formats, frames, name) in [
        ("\"csv\", \"npz\"", 0, "snapshot_20.npz"),
        ("\"png\"", 0, "picture_20.png"),
        ("\"csv\"", 6, "frames/frame_0003.png"),
    ] {
        let scene = SCENE.replace("\"csv\", \"npz\", \"png\"", formats);
        let scene = scene.replace("frames = 6", &format!("frames = {frames}"));
        // A trail would keep pictures to the end.
        let scene = scene.replace("[picture]\n", "[picture]\nauto_frame = false\n").replace("7 steps", "3 steps");
        let place = Place::with(&[("a.toml", &scene)]);
        // A folder is no result, and no file takes its name.
        std::fs::create_dir_all(place.at("out").join(name)).expect("a folder");
        let (code, words) = place.run("a.toml", "out", &[]);
        assert!(code == 8 && words.contains("cannot write") && words.contains(name), "{code} {words}");
        // It ended soon, and the checkpoint before it continues once the name is free.
        let rows = std::fs::read_to_string(place.at("out/energy.csv")).expect("a table").lines().count();
        assert!((2..6).contains(&rows), "{rows} lines");
        let kept = place.checkpoints("out");
        assert!(!kept.is_empty(), "{words}");
        std::fs::remove_dir(place.at("out").join(name)).expect("removed");
        assert_eq!(place.resume("out", &[]).0, 0);
        assert_eq!(place.run("a.toml", "whole", &[]).0, 0);
        assert_eq!(difference(&place.at("out"), &place.at("whole")), None);
    }
}

/// A pipe that is not read is a disk that does not answer: the device continues for some outputs, and no further.
#[cfg(unix)]
#[test]
fn a_slow_disk_holds_the_run_and_the_files_are_the_same() {
    let place = Place::with(&[("a.toml", &many())]);
    assert_eq!(place.run("a.toml", "whole", &["-q"]).0, 0);
    let (done, pipe) = (Arc::new(AtomicU64::new(0)), place.at("out/snapshot_020.csv"));
    let put = Box::new({
        let pipe = pipe.clone();
        move || {
            let made = std::process::Command::new("mkfifo").arg(pipe).status().expect("a program");
            assert!(made.success());
        }
    });
    let (scene, out) = (place.at("a.toml"), place.at("out"));
    let blocks = Blocks { step: 10, put: Some(put), done: done.clone() };
    let running = std::thread::spawn(move || run(&scene, out, blocks));
    // It stands still when it has done nothing for a second.
    let (mut at, mut since, start) = (0, Instant::now(), Instant::now());
    while at < 20 || since.elapsed() < Duration::from_secs(1) {
        let now = done.load(Ordering::Relaxed);
        if now != at {
            (at, since) = (now, Instant::now());
        }
        assert!(start.elapsed() < Duration::from_mins(2) && !running.is_finished(), "at step {at}");
        std::thread::sleep(Duration::from_millis(5));
    }
    // Behind the one that is written 64 files wait: states, and tables that are to be settled, one of each in an output.
    assert!((40..60).contains(&at), "it went on to step {at}");
    let bytes = std::fs::read(&pipe).expect("the pipe is read");
    assert_eq!(running.join().expect("it ends").expect("all is well"), 400);
    assert!(bytes == std::fs::read(place.at("whole/snapshot_020.csv")).expect("read"));
    std::fs::remove_file(&pipe).expect("removed");
    std::fs::write(&pipe, bytes).expect("written");
    assert_eq!(difference(&place.at("out"), &place.at("whole")), None);
}

/// What a run that loses its numbers had written before is there, also what still waited.
#[test]
fn states_before_numbers_are_lost_are_written() {
    let scene = many().replace("[[force]]\nkind = \"gravity\"\n", "[[force]]\nwgsl = \"law.wgsl\"\nover = \"each\"\n");
    let law = "fn force(me: Particle) -> vec4f { return vec4f(1e30 * pow(me.position, vec3f(3.0)), 0.0); }\n";
    let place = Place::with(&[("a.toml", &scene), ("law.wgsl", law)]);
    let (out, scene) = (place.path("out"), place.path("a.toml"));
    let (code, words) = crate::checkpoints::said(&mut crate::checkpoints::motes(&["run", &scene, "-o", &out]));
    assert!(code == 6, "{code} {words}");
    let rows = std::fs::read_to_string(place.at("out/energy.csv")).expect("a table").lines().count() - 1;
    let states = crate::checkpoints::all(&place.at("out")).into_keys().filter(|name| name.starts_with("snapshot_0"));
    assert!(rows > 0 && states.count() == rows, "{rows} rows: {words}");
}
