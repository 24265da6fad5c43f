//! What may go wrong: a disk that is full, a folder that cannot be written, damaged files, another run, another scene.

use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use motes::formats::Precision;
use motes::run::{Checkpoint, Options, Progress, Run, Stop};
use motes::scene::{self, Scene, Source};
use motes::{Cpu, Simulation};
use pollster::block_on;

use crate::checkpoints::library::references;
use crate::checkpoints::{Place, SCENE, all, difference, motes, said};

/// What [`stopped`] sets.
pub const KEEP: [&str; 2] = ["--set", "checkpoint.keep=1"];

/// Asks for an end in the middle.
struct Asks(Stop);

impl Progress for Asks {
    fn at(&mut self, step: u64) {
        if step >= 17 {
            self.0.ask();
        }
    }
}

/// A run that was stopped in the middle, behind checkpoints, one of which is left.
pub fn stopped(place: &Place, out: &str) {
    let _ = std::fs::remove_dir_all(place.at(out));
    let source = Source::find(&place.path("a.toml")).unwrap_or_else(|faults| panic!("{faults}"));
    let sets = ["checkpoint.keep=1".to_owned()];
    let mut scene = Scene::load(&source, &sets, &scene::Options::default()).unwrap_or_else(|faults| panic!("{faults}"));
    let setup = scene.setup();
    let stop = Stop::default();
    let (device, precision) = (references(), Precision::Double);
    let options = Options { device, precision, stop: stop.clone(), ..Options::into(place.at(out)) };
    let mut run = Run::new(scene, &setup, options).expect("a run");
    let cpu = Cpu::new(setup.check().expect("a setup")).expect("a backend");
    let mut simulation = Simulation::on(cpu, &setup).expect("a simulation");
    let end = block_on(run.drive(&mut simulation, &mut Asks(stop))).expect("the end");
    assert!(end.stopped && (17..28).contains(&end.steps), "{end:?}");
    assert_eq!(place.checkpoints(out).len(), 1);
}

#[test]
fn a_run_that_is_stopped_goes_on_with_a_code_of_its_own() {
    let place = Place::with(&[("a.toml", SCENE)]);
    assert_eq!(place.run("a.toml", "whole", &KEEP).0, 0);
    assert!(place.checkpoints("whole").is_empty(), "a complete run needs none");
    stopped(&place, "out");
    // Rows and files behind the checkpoint are no part of it.
    let mut energy = std::fs::read(place.at("out/energy.csv")).expect("a table");
    energy.extend(b"99,0.5\n".repeat(2000));
    std::fs::write(place.at("out/energy.csv"), energy).expect("written");
    std::fs::write(place.at("out/snapshot_99.csv"), "step").expect("written");
    let (code, words) = place.resume("out", &[]);
    assert_eq!(code, 0, "{words}");
    assert!(words.contains("resumes from"), "{words}");
    assert_eq!(difference(&place.at("out"), &place.at("whole")), None);
    // There is nothing to continue with, and that is no failure.
    for (code, words) in [place.resume("out", &[]), place.run("a.toml", "out", &[&["--resume"], &KEEP[..]].concat())] {
        assert!(code == 0 && words.contains("is complete, with step 40"), "{words}");
    }
    // The same by the scene, from nothing, from a checkpoint, and from what a run left before its first.
    assert_eq!(place.run("a.toml", "other", &[&["--resume"], &KEEP[..]].concat()).0, 0);
    assert_eq!(difference(&place.at("other"), &place.at("whole")), None);
    stopped(&place, "third");
    let (code, words) = place.run("a.toml", "third", &[&["--resume"], &KEEP[..]].concat());
    assert_eq!(code, 0, "{words}");
    assert_eq!(difference(&place.at("third"), &place.at("whole")), None);
    stopped(&place, "fourth");
    std::fs::remove_file(&place.checkpoints("fourth")[0]).expect("removed");
    let (code, words) = place.resume("fourth", &[]);
    assert!(code == 8 && words.contains("before its first checkpoint"), "{words}");
    let (code, words) = place.run("a.toml", "fourth", &[&["--resume"], &KEEP[..]].concat());
    assert!(code == 0 && words.contains("results of this scene are removed"), "{words}");
    assert_eq!(difference(&place.at("fourth"), &place.at("whole")), None);
}

#[test]
fn a_limit_of_time_ends_a_run_with_a_checkpoint() {
    let place = Place::with(&[("a.toml", SCENE)]);
    assert_eq!(place.run("a.toml", "whole", &KEEP).0, 0);
    let (code, words) = place.run("a.toml", "out", &[&["--max-hours", "1e-9"], &KEEP[..]].concat());
    assert!(code == 75 && words.contains("stopped at step 0") && words.contains("motes resume"), "{code} {words}");
    assert!(words.contains("out --backend cpu"), "the whole command: {words}");
    assert_eq!(place.checkpoints("out").len(), 1);
    let (code, words) = place.resume("out", &["--max-hours", "1e-9"]);
    assert_eq!(code, 75, "{words}");
    assert_eq!(place.resume("out", &[]).0, 0);
    assert_eq!(difference(&place.at("out"), &place.at("whole")), None);
}

#[test]
fn a_state_from_which_it_was_begun_and_files_of_the_scene_are_kept() {
    let scene = "[simulation]\ndt = 0.1\nsteps = 20\n[[particles]]\nfile = \"bodies.csv\"\n[[force]]\nwgsl = \"pull.wgsl\"\nover = \"each\"\n\
                 [output]\nevery = 5\nformats = [\"npz\"]\n";
    let law = "fn force(me: Particle) -> vec4f { return vec4f(-me.position, 0.0); }\n";
    let place = Place::with(&[("a.toml", scene), ("bodies.csv", "x,y,z\n1,2,3\n2,1,0\n"), ("pull.wgsl", law)]);
    let device = |out: &str, more: &[&str]| {
        said(&mut motes(&[&["run", &place.path("a.toml"), "-o", &place.path(out)], more].concat()))
    };
    let (code, words) = device("first", &["--steps", "10"]);
    assert_eq!(code, 0, "{words}");
    let from = place.path("first/snapshot_10.npz");
    assert_eq!(device("whole", &["--from", &from]).0, 0);
    let (code, words) = device("out", &["--from", &from, "--max-hours", "1e-9"]);
    assert_eq!(code, 75, "{words}");
    // A checkpoint needs nothing beside it.
    for name in ["bodies.csv", "pull.wgsl", "a.toml", "first/snapshot_10.npz"] {
        std::fs::rename(place.at(name), place.at("away")).expect("moved");
    }
    let (code, words) = said(&mut motes(&["resume", &place.path("out")]));
    assert_eq!(code, 0, "{words}");
    let (got, want) = (all(&place.at("out")), all(&place.at("whole")));
    assert_eq!(got.keys().collect::<Vec<_>>(), want.keys().collect::<Vec<_>>());
    for (name, bytes) in &got {
        assert!(want[name] == *bytes, "{name}");
    }
}

#[test]
fn another_scene_is_refused() {
    let place = Place::with(&[("a.toml", SCENE)]);
    stopped(&place, "out");
    let before = all(&place.at("out"));
    for (more, what) in [
        (&["--set", "simulation.dt=0.02"][..], "dt = 0.02"),
        (&["--ledger"], "ledger = true"),
        (&["--fps", "7"], "fps = 7"),
    ] {
        let (code, words) = place.run("a.toml", "out", &[&["--resume"], &KEEP[..], more].concat());
        assert!(code == 3 && words.contains("is of another scene") && words.contains(what), "{words}");
    }
    let (code, words) = place.run("a.toml", "out", &[]);
    assert!(code == 8 && words.contains("--overwrite"), "{words}");
    assert!(all(&place.at("out")) == before, "a refusal changes nothing");
    assert_eq!(place.run("a.toml", "out", &["--overwrite"]).0, 0);
    assert!(place.checkpoints("out").is_empty());
}

/// A checkpoint that is cut or damaged anywhere is never taken for a whole one; the one before it is.
#[test]
fn torn_checkpoints_are_passed_over() {
    let place = Place::with(&[("a.toml", SCENE)]);
    assert_eq!(place.run("a.toml", "whole", &KEEP).0, 0);
    stopped(&place, "out");
    let file = place.checkpoints("out").remove(0);
    let good = std::fs::read(&file).expect("read");
    let newer = place.at("out").join("checkpoint_0000000033.npz");
    let torn = |bytes: &[u8]| {
        std::fs::write(&newer, bytes).expect("written");
        Checkpoint::read(&newer).err().map(|error| error.to_string())
    };
    assert_eq!(torn(&good), None);
    for part in 0..64 {
        let why = torn(&good[..good.len() * part / 64]);
        assert!(why.is_some_and(|why| why.contains("checkpoint_0000000033.npz")), "cut at {part} of 64");
    }
    // A flipped bit is found, or stands where nothing is read: then the file says the same.
    let mut quiet = 0;
    for place in (0..good.len()).step_by(7) {
        let mut bytes = good.clone();
        bytes[place] ^= 1 << (place % 8);
        quiet += usize::from(torn(&bytes).is_none());
    }
    assert!(quiet * 7 < good.len() / 5, "{} of {} bytes may be damaged", quiet * 7, good.len());
    std::fs::write(&newer, &good[..good.len() - 1]).expect("written");
    let (code, words) = place.resume("out", &[]);
    assert_eq!(code, 0, "{words}");
    assert!(words.contains("is damaged, and an older one is used") && words.contains("0000000033"), "{words}");
    assert_eq!(difference(&place.at("out"), &place.at("whole")), None);
    // Where none is whole, it is said, and nothing is lost.
    stopped(&place, "none");
    let file = place.checkpoints("none").remove(0);
    std::fs::write(&file, &good[..good.len() / 2]).expect("written");
    let before = all(&place.at("none"));
    for (code, words) in [place.resume("none", &[]), place.run("a.toml", "none", &["--resume"])] {
        assert!(code == 4 && words.contains("no checkpoint in the folder is intact"), "{words}");
    }
    assert!(all(&place.at("none")) == before);
}

#[test]
fn tables_and_frames_that_are_gone_are_an_error() {
    let place = Place::with(&[("a.toml", SCENE)]);
    for (name, what) in [("energy.csv", "rows are lost"), ("energy.csv", "not the table")] {
        stopped(&place, "out");
        let text = std::fs::read_to_string(place.at("out").join(name)).expect("a table");
        let text = if what.contains("rows") { text[..text.len() / 4].to_owned() } else { text.replace("step", "stop") };
        std::fs::write(place.at("out").join(name), text).expect("written");
        let (code, words) = place.resume("out", &[]);
        assert!(code == 8 && words.contains(name) && words.contains(what), "{words}");
        assert_eq!(place.checkpoints("out").len(), 1);
    }
}

/// A limit on the size of files stands for a full disk.
#[cfg(unix)]
#[test]
fn a_full_disk_is_an_error_and_the_last_checkpoint_stays() {
    let scene = SCENE.replace("bodies = [", "shape = \"box\"\ncount = 2000 # ").replace("\"gravity\"", "\"wander\"");
    let scene = scene.replace("frames = 6", "frames = 0").replace("\"csv\", \"npz\", \"png\"", "");
    let place = Place::with(&[("a.toml", &scene)]);
    assert_eq!(place.run("a.toml", "whole", &KEEP).0, 0);
    stopped(&place, "out");
    let before = place.checkpoints("out");
    let kept = std::fs::read(&before[0]).expect("read");
    // In blocks of 512 bytes or 1024: less than a checkpoint, and more than the tables.
    let script = "ulimit -f 20; exec \"$0\" resume \"$1\" --backend cpu";
    let mut command = Command::new("bash");
    let (code, words) = said(command.args(["-c", script, env!("CARGO_BIN_EXE_motes"), &place.path("out")]));
    assert_eq!(code, 8, "{words}");
    assert!(words.contains("cannot write") && words.contains("checkpoint_00000000"), "{words}");
    assert_eq!(place.checkpoints("out"), before);
    assert!(std::fs::read(&before[0]).expect("read") == kept, "the last good one is touched");
    assert_eq!(place.resume("out", &[]).0, 0);
    assert_eq!(difference(&place.at("out"), &place.at("whole")), None);
}

/// Whether this process may write where it must not, as the superuser may.
#[cfg(unix)]
fn may_write_anywhere(folder: &Path) -> bool {
    std::fs::write(folder.join("probe"), "").is_ok()
}

#[cfg(unix)]
#[test]
fn a_folder_that_cannot_be_written_is_an_error() {
    use std::os::unix::fs::PermissionsExt;
    let place = Place::with(&[("a.toml", SCENE)]);
    stopped(&place, "out");
    let before = all(&place.at("out"));
    let mode = |mode: u32| {
        std::fs::set_permissions(place.at("out"), std::fs::Permissions::from_mode(mode)).expect("permissions");
    };
    mode(0o555);
    let (code, words) = if may_write_anywhere(&place.at("out")) {
        std::fs::remove_file(place.at("out").join("probe")).expect("removed");
        mode(0o755);
        // The superuser: a file in place of the folder stands for it.
        std::fs::write(place.at("file"), "").expect("written");
        place.run("a.toml", "file", &[])
    } else {
        place.resume("out", &[])
    };
    mode(0o755);
    assert!(code == 8 && words.contains("cannot write"), "{code} {words}");
    assert!(all(&place.at("out")) == before);
}

#[test]
fn a_second_run_is_refused_and_a_dead_one_holds_no_lock() {
    let place = Place::with(&[("a.toml", SCENE)]);
    let (scene, out) = (place.path("a.toml"), place.path("out"));
    let mut command = motes(&[
        "run",
        &scene,
        "-o",
        &out,
        "--backend",
        "cpu",
        "--steps",
        "200000000",
        "-q",
        "--set",
        "output.frames=0",
    ]);
    let mut child = command.spawn().expect("the program starts");
    let start = Instant::now();
    while !all_exist(&place.at("out")) && start.elapsed() < Duration::from_mins(1) {
        std::thread::sleep(Duration::from_millis(20));
    }
    let refused = [
        place.resume("out", &[]),
        place.run("a.toml", "out", &["--resume"]),
        place.run("a.toml", "out", &["--overwrite"]),
    ];
    child.kill().expect("killed");
    child.wait().expect("it ends");
    for (code, words) in refused {
        assert!(code == 8 && words.contains("another run writes into this folder"), "{words}");
    }
    let (code, words) = place.resume("out", &["--max-hours", "1e-9"]);
    assert_eq!(code, 75, "{words}");
}

/// Whether a run has begun, and written a checkpoint.
fn all_exist(out: &Path) -> bool {
    // Files come and go there: names alone are looked at.
    let Ok(entries) = std::fs::read_dir(out) else { return false };
    entries.flatten().any(|entry| entry.file_name().to_string_lossy().starts_with("checkpoint_"))
}

#[test]
fn history_of_pairs_goes_on() {
    let scene = "[simulation]\ndt = 0.0001\nsteps = 30000\n[[particles]]\nshape = \"box\"\ncount = 40\n[[force]]\nwgsl = \"law.wgsl\"\n\
                 over = \"list\"\nrange = 0.5\nslots = 2\n[output]\nevery = 10000\nformats = [\"npz\"]\n[checkpoint]\nevery = \"never\"\n";
    // A count, and an id that is kept as bits: most of these are no finite numbers.
    let law = "struct Sum { acceleration: vec3f }\nfn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {\n\
               remember(you, 0u, recall(you, 0u) + 1.0);\nremember(you, 1u, bitcast<f32>(0x7f900000u + you.index));\n\
               let known = bitcast<u32>(recall(you, 1u)) & 63u;\n\
               (*sum).acceleration += 1e-4 * r * recall(you, 0u) * f32(known);\n}\n\
               fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, 0.0); }\n";
    let place = Place::with(&[("a.toml", scene), ("law.wgsl", law)]);
    let (scene, whole) = (place.path("a.toml"), place.path("whole"));
    let (code, words) = said(&mut motes(&["run", &scene, "-o", &whole]));
    assert_eq!(code, 0, "{words}");
    // As long as it takes until some steps are done, and not all of them.
    let stopped = (0..12).find_map(|n| {
        let out = format!("out{n}");
        let hours = format!("{:e}", 1e-4 * 1.6_f64.powi(n));
        let (code, words) = said(&mut motes(&["run", &scene, "-o", &place.path(&out), "--max-hours", &hours]));
        let is_there = place.checkpoints(&out).iter().any(|path| !path.ends_with("checkpoint_0000000000.npz"));
        assert!(code == 0 || code == 75 && words.contains("motes resume"), "{words}");
        (code == 75 && is_there).then_some(out)
    });
    let out = stopped.expect("a run that was stopped on its way");
    let (code, words) = said(&mut motes(&["resume", &place.path(&out)]));
    assert_eq!(code, 0, "{words}");
    assert_eq!(crate::checkpoints::difference(&place.at(&out), &place.at("whole")), None);
}
