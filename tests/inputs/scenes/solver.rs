//! `[solver]` and `[checkpoint]`: what is out of reach is reported with its bounds, and what is not is kept.

use motes::Solver;
use motes::scene::{Checkpoints, Every};

use crate::scenes::{SMALL, assert_report, load};

#[test]
fn values_are_read_and_have_defaults() {
    let of = |text: &str| load(&(SMALL.to_owned() + text), &[]).unwrap_or_else(|faults| panic!("{faults}")).solver;
    assert_eq!(of(""), Solver { tolerance: 1e-3, iterations: 100, solves: 8 });
    let given = of("[solver]\ntolerance = 0.02\niterations = 7\nsolves = 3\n");
    assert_eq!(given, Solver { tolerance: 0.02, iterations: 7, solves: 3 });
    // The last that are good.
    let edges = of("[solver]\ntolerance = 1e-6\niterations = 10000\nsolves = 100\n");
    assert_eq!(edges, Solver { tolerance: 1e-6, iterations: 10_000, solves: 100 });
    assert!(edges.check().is_ok());
}

#[test]
fn values_out_of_reach() {
    assert_report(
        &(SMALL.to_owned() + "[solver]\ntolerance = 9e-7\niterations = 10001\nsolves = 101\n"),
        &[],
        "error: `tolerance` is out of range
  --> a.toml:7:13
   |
 7 | tolerance = 9e-7
   |             ^^^^ it must be at least 1e-6, the limit of single precision, and below 1

error: `iterations` is out of range
  --> a.toml:8:14
   |
 8 | iterations = 10001
   |              ^^^^^ at most 10000

error: `solves` is out of range
  --> a.toml:9:10
   |
 9 | solves = 101
   |          ^^^ at most 100

a.toml: 3 errors",
    );
    assert_report(
        &(SMALL.to_owned() + "[solver]\ntolerance = 1\niterations = 0\nsolves = 2.5\ntolerence = 0.1\n"),
        &[],
        "error: `tolerance` is out of range
  --> a.toml:7:13
   |
 7 | tolerance = 1
   |             ^ it must be at least 1e-6, the limit of single precision, and below 1

error: `iterations` must be a whole number, one or above, not 0
  --> a.toml:8:14
   |
 8 | iterations = 0
   |              ^

error: `solves` must be a whole number, one or above, not 2.5
  --> a.toml:9:10
   |
 9 | solves = 2.5
   |          ^^^

error: unknown key `tolerence` in [solver]
  --> a.toml:10:1
   |
10 | tolerence = 0.1
   | ^^^^^^^^^ did you mean `tolerance`?
   = known here: `tolerance`, `iterations`, `solves`

a.toml: 4 errors",
    );
    assert_report(
        SMALL,
        &["solver.tolerance=1"],
        "error: `tolerance` is out of range
  --> the command line
   |
   | --set solver.tolerance=1
   |                        ^ it must be at least 1e-6, the limit of single precision, and below 1

a.toml: 1 error",
    );
}

#[test]
fn intervals_of_checkpoints() {
    let of = |text: &str| load(&(SMALL.to_owned() + text), &[]).unwrap_or_else(|faults| panic!("{faults}")).checkpoint;
    let every = |text: &str| of(&format!("[checkpoint]\nevery = \"{text}\"\nkeep = 3\n"));
    assert_eq!(of(""), Checkpoints { every: Every::Wall(600.0), keep: 2 });
    assert_eq!(every("90 s"), Checkpoints { every: Every::Wall(90.0), keep: 3 });
    assert_eq!(every("0.5 time"), Checkpoints { every: Every::Time(0.5), keep: 3 });
    assert_report(
        &(SMALL.to_owned() + "[checkpoint]\nevery = \"0 steps\"\n"),
        &[],
        "error: `every` is not a valid interval
  --> a.toml:7:9
   |
 7 | every = \"0 steps\"
   |         ^^^^^^^^^ it must be a number and a unit: \"10 min\" (s, min or h) of wall-clock time, \"5000 steps\", \"0.5 time\" of the scene, or \"never\"

a.toml: 1 error",
    );
}

#[test]
fn intervals_of_outputs() {
    let every = |words: &str, dt: &str| {
        let scene = format!("[output]\nevery = {words}\n{SMALL}");
        load(&scene, &[format!("simulation.dt={dt}").as_str()])
            .map(|scene| scene.output.every)
            .map_err(|faults| faults.to_string())
    };
    assert_eq!(
        [every("7", "0.01"), every("\"0.5 time\"", "0.01"), every("\"0.3 time\"", "0.1")],
        [Ok(7), Ok(50), Ok(3)]
    );
    assert_eq!([every("\"1e3 time\"", "1e-6"), every("\"1 time\"", "1")], [Ok(1_000_000_000), Ok(1)]);
    for (words, dt, why) in [
        ("\"0.5 time\"", "0.2", "0.5 is 2.5 steps of dt = 0.2: choose a multiple of dt"),
        ("\"0.1 time\"", "0.25", "0.1 is 0.4 steps"),
        ("\"1e300 time\"", "1e-9", "choose a multiple of dt"),
        ("\"10 min\"", "0.01", "wall-clock time is only for [checkpoint]"),
        ("\"-1 time\"", "0.01", "a whole number of steps, or time of the scene"),
        ("\"NaN time\"", "0.01", "a whole number of steps, or time of the scene"),
        ("\"0 time\"", "0.01", "a whole number of steps, or time of the scene"),
        ("\"time\"", "0.01", "a whole number of steps, or time of the scene"),
        ("0", "0.01", "one or above, not 0"),
    ] {
        let said = every(words, dt).expect_err(words);
        assert!(said.contains(why) && said.contains("`every`"), "{words} of {dt}: {said}");
    }
}
