//! Signals end a run after everything up to there is written.
#![cfg(target_os = "linux")]

use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use crate::process::{Place, Running, SCENE, motes};

/// Starts a run that continues for minutes, and waits until it has begun.
fn begun(mut command: Command, out: &str) -> Running {
    let child = command.stdout(Stdio::piped()).stderr(Stdio::null()).spawn().expect("the program starts");
    let child = Running(child);
    let start = Instant::now();
    while !Path::new(out).join("snapshot_000000000.csv").exists() {
        assert!(start.elapsed() < Duration::from_mins(1), "the run does not begin");
        std::thread::sleep(Duration::from_millis(20));
    }
    child
}

fn send(signal: &str, child: &Running) {
    let sent = Command::new("kill").args([signal, &child.0.id().to_string()]).status().expect("kill");
    assert!(sent.success(), "{signal}");
}

#[test]
fn every_signal_that_asks_for_an_end_gets_a_whole_one() {
    for signal in ["-INT", "-TERM", "-HUP"] {
        let place = Place::with(&[("a.toml", SCENE)]);
        let (scene, out) = (place.at("a.toml"), place.at("out"));
        // The tests may run with hang-ups ignored, as under `nohup`; then this program would ignore them, too.
        let mut command = Command::new("env");
        command.args(["--default-signal", env!("CARGO_BIN_EXE_motes"), "run", &scene, "-o", &out]);
        command.args(["--backend", "cpu", "--steps", "200000000"]);
        let mut child = begun(command, &out);
        send(signal, &child);
        // A few lines fit the pipe.
        let code = child.ended();
        let mut said = String::new();
        let stdout = child.0.stdout.as_mut().expect("a pipe");
        std::io::Read::read_to_string(stdout, &mut said).expect("words");
        assert_eq!(code, Some(75), "{signal}: {said}");
        assert!(said.contains("stopped at step"), "{signal}: {said}");
        let names = place.names("out");
        let states = names.iter().filter(|name| name.starts_with("snapshot_")).count();
        // A signal may come before the first step ends: then the first state is the last one too.
        let least = if said.contains("stopped at step 0") { 1 } else { 2 };
        assert!(states >= least && names.contains(&"energy.svg".to_owned()), "{signal}: {names:?}");
        assert!(place.text("out/energy.csv").lines().skip(1).all(|row| row.split(',').count() == 11), "{signal}");
    }
}

/// `nohup` ignores hang-ups for the programs that it starts.
#[test]
fn a_hang_up_that_is_ignored_stays_ignored() {
    let place = Place::with(&[("a.toml", SCENE)]);
    let (scene, out) = (place.at("a.toml"), place.at("out"));
    let mut command = Command::new("sh");
    let script = "trap '' HUP; exec \"$0\" run \"$1\" -o \"$2\" --backend cpu --steps 200000000";
    command.args(["-c", script, env!("CARGO_BIN_EXE_motes"), &scene, &out]);
    let mut child = begun(command, &out);
    send("-HUP", &child);
    std::thread::sleep(Duration::from_millis(1500));
    assert!(child.0.try_wait().expect("a status").is_none(), "it ended");
    send("-TERM", &child);
    assert_eq!(child.ended(), Some(75));
}

/// A long step is not waited for twice.
#[test]
fn a_second_signal_ends_at_once() {
    let place = Place::with(&[("a.toml", &SCENE.replace("bodies = ", "shape = \"sphere\"\ncount = 30000 # "))]);
    let (scene, out) = (place.at("a.toml"), place.at("out"));
    let mut command = motes(&["run", &scene, "-o", &out, "--backend", "cpu", "--steps", "2000"]);
    let child = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn();
    let mut child = Running(child.expect("the program starts"));
    let start = Instant::now();
    while !Path::new(&out).join("energy.csv").exists() {
        assert!(start.elapsed() < Duration::from_mins(1), "the run does not begin");
        std::thread::sleep(Duration::from_millis(20));
    }
    send("-TERM", &child);
    std::thread::sleep(Duration::from_millis(200));
    send("-TERM", &child);
    assert_eq!(child.ended(), Some(130), "the first step takes seconds");
}
