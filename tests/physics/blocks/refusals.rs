//! What block time steps refuse, and how they say so.

use glam::DVec3;
use motes::error::Error;
use motes::forces::{Component, Custom, Over};
use motes::kernel::BlockSteps;
use motes::motion::{Held, Hold};
use motes::settings::Value;
use motes::{Bounds, Setup, Side};

use super::{cusp, gravity, on_gpu, setup, steps};
use crate::support;
use crate::support::states::{force, vector, word};

fn refused(setup: &Setup, why: &str) {
    let shared = support::device();
    let made = motes::Simulation::new(&shared.found.device, &shared.found.queue, setup);
    match made.map(|_| ()) {
        Err(error) => assert!(error.to_string().contains(why), "{error}"),
        Ok(()) => panic!("accepted, in spite of: {why}"),
    }
}

#[test]
fn what_acts_within_steps_is_refused() {
    let state = || cusp(40, 0.1, 1);
    let with =
        |more: Box<dyn Component>| setup(state(), vec![gravity(1.0, 0.01, "pairs", 0.0), more], 0.01, steps(4, 0.0));
    refused(
        &with(force("speed_limit", &[("max", Value::Number(1.0))])),
        "speed_limit changes positions or velocities other than by forces",
    );
    refused(
        &with(force(
            "lennard_jones",
            &[
                ("epsilon", Value::Number(0.01)),
                ("sigma", Value::Number(0.01)),
                ("range", Value::Number(0.05)),
                ("over", word("list")),
            ],
        )),
        "lennard_jones is over a neighbour list",
    );
    refused(&with(force("wander", &[("strength", Value::Number(0.1))])), "wander is for steps of equal length");
    refused(&with(force("langevin", &[("temperature", Value::Number(0.1))])), "langevin is for steps of equal length");
    let text = "fn force(me: Particle) -> vec4f { return vec4f(0.1 / world.dt, 0.0, 0.0, 0.0); }";
    let reads = Custom::new("kick", "kick.wgsl", text, Over::Each);
    refused(&with(Box::new(reads)), "kick reads `world.dt`");
    let mut held = setup(state(), vec![gravity(1.0, 0.01, "pairs", 0.0)], 0.01, steps(4, 0.0));
    held.state.held = vec![Held { id: 3, by: Hold::Target }];
    refused(&held, "particles are moved along paths");
    let mut grows = setup(state(), vec![gravity(1.0, 0.01, "pairs", 0.0)], 0.01, steps(4, 0.0));
    grows.state.capacity = Some(50);
    refused(&grows, "spawned or removed");
    // What is done between steps, and a law on each particle, are not.
    let wind = with(force("wind", &[("velocity", vector(0.1, 0.0, 0.0))]));
    let shared = support::device();
    on_gpu(&shared, &wind).step(1).expect("a step");
}

#[test]
fn numbers_out_of_range_are_refused() {
    let with = |steps: BlockSteps| setup(cusp(40, 0.1, 1), vec![gravity(1.0, 0.01, "pairs", 0.0)], 0.01, steps);
    refused(&with(steps(0, 0.0)), "0 levels: choose 1 to 10");
    refused(&with(steps(11, 0.0)), "11 levels: choose 1 to 10");
    for eta in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        refused(&with(BlockSteps { eta, ..steps(4, 0.0) }), "choose one above 0; 0.025 is usual");
    }
    for mass in [-1.0, f64::NAN, f64::INFINITY] {
        refused(&with(BlockSteps { mass, ..steps(4, 0.0) }), "the mass of block steps");
    }
    for length in [-1.0, f64::NAN, f64::INFINITY] {
        refused(&with(steps(4, length)), "the length of block steps");
    }
    refused(&with(steps(4, 1e-50)), "out of the range of single precision");
    let bare = setup(cusp(40, 0.1, 1), vec![gravity(1.0, 0.0, "pairs", 0.0)], 0.01, steps(4, 0.0));
    refused(&bare, "no gravity with a softening");
}

#[test]
fn a_run_ends_where_levels_do_not_suffice() {
    let shared = support::device();
    // The second particle is much nearer to the first than all others.
    let mut state = cusp(300, 0.1, 5);
    state.position_mut()[7] = DVec3::new(0.001, 0.0, 0.0);
    let mut simulation = on_gpu(&shared, &setup(state, vec![gravity(1.0, 1e-4, "pairs", 0.0)], 0.01, steps(6, 0.002)));
    pollster::block_on(simulation.check()).expect("nothing yet");
    simulation.step(2).expect("steps");
    let error = pollster::block_on(simulation.check()).expect_err("too few levels");
    // |a| = 1e-3 / (1e-6 + 1e-8)^1.5 = 985 000: √(2 · 0.025 · 0.002 / a) = 1.007e-5, below dt / 2⁹ = 1.95e-5 and above dt / 2¹⁰.
    match error {
        Error::TooManyLevels { step: 0, particle: 7, wanted, levels: 6, .. } => {
            assert!((wanted - 0.01 / 1024.0).abs() < 1e-12, "{wanted:e}");
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_periodic_box_encloses_after_every_part() {
    let shared = support::device();
    let mut setup = setup(cusp(300, 0.1, 6), vec![gravity(1.0, 0.01, "pairs", 0.0)], 0.02, steps(5, 0.0));
    setup.bounds = Bounds::new(DVec3::splat(-1.1), DVec3::splat(1.1), Side::Periodic);
    let mut simulation = on_gpu(&shared, &setup);
    simulation.step(40).expect("steps");
    let end = super::state(&mut simulation);
    assert!(end.position().iter().all(|x| x.abs().max_element() <= 1.1));
}
