//! Real processes are killed at random instants, also while they write a checkpoint, until the run is complete.

use std::process::{Child, Stdio};
use std::sync::Mutex;
use std::time::{Duration, Instant};

use rand_pcg::Pcg64Mcg;
use rand_pcg::rand_core::Rng;

use crate::checkpoints::{Place, difference, motes, said};

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
formats = ["csv", "npz", "hdf5", "png"]
files = 2
compress = true
frames = 9
[picture]
width = 32
height = 24
[checkpoint]
every = "2 steps"
"#;

/// How often runs are killed, where `MOTES_KILLS` says nothing else.
const KILLS: usize = 200;
/// Runs that are killed beside each other.
const LANES: u64 = 3;
/// Of each run: its description names them.
const CORES: &str = "1";

/// What was done to runs.
#[derive(Debug, Default)]
struct Count {
    kills: usize,
    runs: usize,
    /// Kills that left a checkpoint, and kills inside of a write.
    resumed: usize,
    written: usize,
    /// The most kills of one run.
    longest: usize,
}

#[test]
fn no_run_is_lost_however_often_it_is_killed() {
    let wanted: usize = std::env::var("MOTES_KILLS").ok().and_then(|kills| kills.parse().ok()).unwrap_or(KILLS);
    let place = Place::with(&[("a.toml", SCENE)]);
    let start = Instant::now();
    let (scene, out) = (place.path("a.toml"), place.path("whole"));
    let args = ["run", &scene, "-o", &out, "--backend", "cpu", "-q"];
    let (code, words) = said(motes(&args).env("RAYON_NUM_THREADS", CORES));
    assert_eq!(code, 0, "{words}");
    let (whole, start, count) = (start.elapsed(), Instant::now(), Mutex::new(Count::default()));
    std::thread::scope(|scope| {
        for lane in 0..LANES {
            let (place, count) = (&place, &count);
            scope.spawn(move || kill(place, lane, whole, count, wanted));
        }
    });
    let Count { kills, runs, resumed, written, longest } = count.into_inner().expect("all lanes are well");
    println!(
        "{kills} kills of {runs} runs in {:?}, {resumed} with a checkpoint, {written} inside of a write, {longest} of one run; none is lost",
        start.elapsed()
    );
    assert!(
        resumed > 10 && written > 0 && runs > 0,
        "{kills} kills, {resumed} with a checkpoint, {written} inside of a write"
    );
}

/// Kills runs, one behind another, each until it is complete, and compares what it left.
fn kill(place: &Place, lane: u64, whole: Duration, count: &Mutex<Count>, wanted: usize) {
    let mut random = Pcg64Mcg::new(0x5eed_0bad_cafe + u128::from(lane));
    // A quarter of what a run takes in one go, at first; how fast it is depends on all else that runs.
    let mut longest = whole.mul_f64(0.25);
    for run in 0.. {
        if count.lock().expect("all lanes are well").kills >= wanted {
            break;
        }
        let name = format!("run{lane}_{run}");
        let (scene, out) = (place.path("a.toml"), place.path(&name));
        let mut of_run = 0;
        loop {
            let mut command = motes(&["run", &scene, "-o", &out, "--backend", "cpu", "--resume", "-q"]);
            command.env("RAYON_NUM_THREADS", CORES);
            let child = command.stdout(Stdio::null()).stderr(Stdio::piped()).spawn().expect("the program starts");
            let mut child = Running(child);
            let part = f64::from(random.next_u32()) / f64::from(u32::MAX);
            let pause = longest.mul_f64(part);
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
                assert!(status.success(), "run {name} after {of_run} kills: {status} {words}");
                // Some kills for each run.
                longest = longest.mul_f64(if of_run < 8 { 0.7 } else { 1.0 });
                break;
            }
            child.0.kill().expect("killed");
            child.0.wait().expect("it ends");
            of_run += 1;
            let parts = std::fs::read_dir(place.at(&name)).into_iter().flatten().flatten();
            let is_written = parts.filter(|entry| entry.file_name().to_string_lossy().ends_with(".part")).count() > 0;
            // A run that comes to no checkpoint would never end.
            longest = longest.mul_f64(if place.at(&name).is_dir() { 1.02 } else { 1.2 });
            let mut count = count.lock().expect("all lanes are well");
            count.kills += 1;
            count.written += usize::from(is_written);
            count.resumed += usize::from(place.at(&name).is_dir() && !place.checkpoints(&name).is_empty());
        }
        if let Some(what) = difference(&place.at(&name), &place.at("whole")) {
            panic!("run {name}, which was killed {of_run} times: {what}");
        }
        std::fs::remove_dir_all(place.at(&name)).expect("removed");
        let mut count = count.lock().expect("all lanes are well");
        count.runs += 1;
        count.longest = count.longest.max(of_run);
    }
}
