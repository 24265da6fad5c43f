//! `[solver]`: what is out of reach is told with its bounds, and what is not is kept.

use motes::Solver;

use crate::{SMALL, assert_report, load};

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
    assert_report(&(SMALL.to_owned() + "[solver]\ntolerance = 9e-7\niterations = 10001\nsolves = 101\n"), &[], "");
    assert_report(
        &(SMALL.to_owned() + "[solver]\ntolerance = 1\niterations = 0\nsolves = 2.5\ntolerence = 0.1\n"),
        &[],
        "",
    );
    assert_report(SMALL, &["solver.tolerance=1"], "");
}
