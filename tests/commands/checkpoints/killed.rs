//! Real processes are killed at random instants, also while they write a checkpoint, until the run is complete.

use std::process::{Child, Stdio};
use std::time::{Duration, Instant};

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::Rng;

use crate::checkpoints::{Place, difference, motes};

/// Ended with the test, however that ends.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

/// Enough particles that a good part of the time goes into checkpoints, and everything that a run writes.
const SCENE: &str = r#"[simulation]
dt = 0.01
steps = 120
[[particles]]
shape = "box"
count = 120
size = [2, 2, 2]
speed = 0.5
[[force]]
kind = "boids"
[[force]]
kind = "wander"
[[drain]]
radius = 1.4
outside = true
[output]
every = 15
formats = ["csv", "npz", "png"]
frames = 9
[picture]
width = 32
height = 24
[checkpoint]
every = "2 steps"
"#;

/// How long runs are killed: as many kills as fit.
const SECONDS: u64 = 60;

#[test]
fn no_run_is_lost_however_often_it_is_killed() {
    let wanted: usize = std::env::var("MOTES_KILLS").ok().and_then(|kills| kills.parse().ok()).unwrap_or(0);
    let place = Place::with(&[("a.toml", SCENE)]);
    let start = Instant::now();
    let (code, words) = place.run("a.toml", "whole", &["-q"]);
    assert_eq!(code, 0, "{words}");
    let whole = start.elapsed();
    let (mut random, start) = (Pcg64Mcg::new(0x5eed_0bad_cafe), Instant::now());
    let (mut kills, mut runs, mut resumed, mut longest, mut written) = (0, 0, 0, 0, 0);
    while kills < wanted || wanted == 0 && start.elapsed() < Duration::from_secs(SECONDS) {
        let name = format!("run{runs}");
        let (scene, out) = (place.path("a.toml"), place.path(&name));
        let mut of_run = 0;
        loop {
            let mut command = motes(&["run", &scene, "-o", &out, "--backend", "cpu", "--resume", "-q"]);
            let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("the program starts");
            let mut child = Running(child);
            // From its start on, for a quarter of what a run takes in one go.
            let part = f64::from(random.next_u32()) / f64::from(u32::MAX);
            let pause = whole.mul_f64(0.25 * part);
            let begun = Instant::now();
            let ended = loop {
                match child.0.try_wait().expect("a status") {
                    Some(status) => break Some(status),
                    None if begun.elapsed() >= pause => break None,
                    None => std::thread::sleep(Duration::from_micros(200)),
                }
            };
            if let Some(status) = ended {
                let mut words = String::new();
                std::io::Read::read_to_string(child.0.stderr.as_mut().expect("a pipe"), &mut words).expect("words");
                assert!(status.success(), "run {runs} after {of_run} kills: {status} {words}");
                break;
            }
            child.0.kill().expect("killed");
            child.0.wait().expect("it ends");
            kills += 1;
            of_run += 1;
            let parts = std::fs::read_dir(place.at(&name)).into_iter().flatten().flatten();
            written += parts.filter(|entry| entry.file_name().to_string_lossy().ends_with(".part")).count().min(1);
            resumed += usize::from(place.at(&name).is_dir() && !place.checkpoints(&name).is_empty());
        }
        longest = longest.max(of_run);
        if let Some(what) = difference(&place.at(&name), &place.at("whole")) {
            panic!("run {runs}, which was killed {of_run} times: {what}");
        }
        runs += 1;
        std::fs::remove_dir_all(place.at(&name)).expect("removed");
    }
    println!(
        "{kills} kills of {runs} runs in {:?}, {resumed} with a checkpoint, {written} inside of a write, {longest} of one run; none is lost",
        start.elapsed()
    );
    assert!(
        resumed > 10 && written > 0 && runs > 0,
        "{kills} kills, {resumed} with a checkpoint, {written} inside of a write"
    );
}
