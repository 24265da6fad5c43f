//! What iterations cost that are not needed: `cargo test --test physics -- --ignored --nocapture idle` measures.

use std::time::Instant;

use motes::Solver;

use crate::implicit::cloth::cloth;
use crate::implicit::{on_device, phase, setup};
use crate::support;
use crate::support::states::{force, vector};

#[test]
#[ignore = "a measurement"]
fn idle_iterations() {
    let shared = support::device();
    let particles = cloth(32, 100.0 * 0.25 * 3600.0);
    let mut took = Vec::new();
    for iterations in [50, 550] {
        let forces = vec![force("uniform", &[("acceleration", vector(0.0, 0.0, -9.81))]), force("spring", &[])];
        let solver = Solver { tolerance: 1e-3, iterations, solves: 1 };
        let mut simulation =
            on_device(&shared, &setup(&particles, forces, "linear_backward_euler", 1.0 / 60.0, solver));
        simulation.step(2).expect("steps");
        phase(&mut simulation, 0);
        let start = Instant::now();
        simulation.step(10).expect("steps");
        phase(&mut simulation, 0);
        took.push(start.elapsed().as_secs_f64() / 10.0);
        println!("{iterations} iterations at most: {:.2} ms a step", took[took.len() - 1] * 1e3);
    }
    println!("an iteration that is not needed: {:.1} us", (took[1] - took[0]) / 500.0 * 1e6);
}
