//! Standard output that is full, and threads that cannot be had.
#![cfg(target_os = "linux")]

use std::fs::OpenOptions;
use std::process::{Command, Stdio};

use crate::process::{Place, SCENE, motes, output};

#[test]
fn words_that_are_lost_are_a_failure() {
    let place = Place::with(&[("a.toml", SCENE)]);
    let scene = place.at("a.toml");
    let full = || OpenOptions::new().write(true).open("/dev/full").expect("a full device");
    for args in [
        &["check", &scene, "--backend", "cpu"][..],
        &["explain", &scene, "--backend", "cpu"],
        &["scenes"],
        &["scenes", "kepler"],
        &["scenes", "--keys"],
        &["--help"],
        &["--version"],
    ] {
        let output = motes(args).stdout(full()).stderr(Stdio::piped()).output().expect("the program starts");
        let stderr = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(8), "{args:?}: {stderr}");
        assert!(stderr.contains("cannot write standard output"), "{args:?}: {stderr}");
    }
    // Another failure is reported as such; and results are written whether words are or not.
    let output = motes(&["scenes", "kepller"]).stdout(full()).output().expect("the program starts");
    assert_eq!(output.status.code(), Some(3));
    let out = place.at("out");
    let args = ["run", &scene, "-o", &out, "--backend", "cpu"];
    let output = motes(&args).stdout(full()).output().expect("the program starts");
    assert_eq!(output.status.code(), Some(8));
    assert!(place.names("out").contains(&"snapshot_20.csv".to_owned()));
}

/// A reader that has enough closes the pipe.
#[test]
fn a_closed_pipe_is_no_failure() {
    let script = "set -o pipefail; \"$0\" scenes --keys | head -1";
    let (code, stdout, stderr) =
        output(Command::new("bash").args(["-c", script, env!("CARGO_BIN_EXE_motes")]).stdin(Stdio::null()));
    assert!(code == 0 && stdout.lines().count() == 1 && stderr.is_empty(), "{code} {stdout}{stderr}");
}

/// No address space holds such a stack, whatever the program itself needs.
#[test]
fn threads_that_cannot_be_started_are_an_error() {
    let place = Place::with(&[("a.toml", SCENE)]);
    let mut command = motes(&["run", &place.at("a.toml"), "-o", &place.at("out"), "--backend", "cpu", "-q"]);
    let (code, _, stderr) = output(command.env("RUST_MIN_STACK", (1_u64 << 48).to_string()));
    assert!(code == 7 && stderr.contains("threads") && stderr.contains("ulimit"), "exit {code}\n{stderr}");
}

/// Memory that ends while the program starts ends it with a message and never with a panic.
#[test]
fn little_memory_is_no_panic() {
    let place = Place::with(&[("a.toml", SCENE)]);
    let mut errors = 0;
    for limit in (16_000..200_000).step_by(4_000) {
        let script = format!("ulimit -v {limit}; exec \"$0\" run \"$1\" -o \"$2\" --backend cpu -q");
        let out = place.at(&format!("out{limit}"));
        let mut command = Command::new("bash");
        let (code, _, stderr) =
            output(command.args(["-c", &script, env!("CARGO_BIN_EXE_motes"), &place.at("a.toml"), &out]));
        // Rust's own runtime ends a process that has no memory for the signal stack of a thread that has just begun, or for 512 bytes.
        if stderr.contains("alternative stack") || stderr.contains("memory allocation of") {
            continue;
        }
        assert!(code != 101 && !stderr.contains("panicked"), "with {limit} KiB: exit {code}\n{stderr}");
        errors += usize::from(stderr.starts_with("error: "));
    }
    assert!(errors > 0, "no limit leaves room for the program to begin and none for it to end");
}
