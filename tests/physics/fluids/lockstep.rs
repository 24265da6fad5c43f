//! The device against the references, kernel by kernel.

use motes::kernel::Backend;
use motes::lockstep::compare;
use motes::settings::Value;
use motes::{Side, Simulation};

use crate::fluids::setup;
use crate::support::fluids::{bounds, cloud, fluid};
use crate::support::machines::gpu;
use crate::support::states::{vector, word};
use crate::support::{self, Shared};
use Value::Number;

fn agree(shared: &Shared, count: usize, flat: bool, side: Side, walls: bool, more: &[(&'static str, Value)]) {
    let name = format!("{count} particles, flat {flat}, {side:?}, walls {walls}, {more:?}");
    let particles = cloud(count, flat, walls);
    let setup = setup(&particles, vec![fluid(more)], "leapfrog", 0.003, bounds(count, flat, side));
    let mut simulation = Simulation::on(gpu(shared, count), &setup).expect("a simulation");
    let plans = setup.plans(simulation.backend().machine()).expect("plans");
    let mut seen = Vec::new();
    for plan in [plans.start, plans.step] {
        let verdicts = pollster::block_on(compare(simulation.backend(), &plan, count as u32)).expect("verdicts");
        for verdict in verdicts {
            // The density of a start that runs again hardly changes: what is known of it is what its inputs say.
            assert!(verdict.sound(), "{name}: {verdict:?}");
            if verdict.changed {
                seen.push(verdict.kernel);
            }
        }
    }
    let weighs = |kernel: &&str| walls || !kernel.contains("walls");
    if more.iter().any(|(key, _)| *key == "density_by") {
        for kernel in ["fluid density rate", "carry density", "fluid wall pressure", "fluid wall state", "fluid xsph"] {
            assert!(seen.iter().any(|name| name == kernel), "{name}: {kernel} changes nothing");
        }
        return;
    }
    for kernel in ["fluid walls", "fluid density", "fluid state", "fluid pressure"].iter().filter(|k| weighs(k)) {
        assert!(count < 63 || seen.iter().any(|name| name == kernel), "{name}: {kernel} changes nothing");
    }
}

/// All that a density as a state brings with it, and walls of their own.
fn state() -> Vec<(&'static str, Value)> {
    vec![
        ("density_by", word("continuity")),
        ("diffusion", Number(0.2)),
        ("xsph", Number(0.3)),
        ("weight", vector(0.3, -0.9, 0.0)),
        ("walls", word("extrapolate")),
        ("wall_mass", word("lattice")),
    ]
}

fn surface() -> Vec<(&'static str, Value)> {
    vec![("tension", Number(0.4)), ("adhesion", Number(700.0))]
}

/// The same over a kept list.
fn listed(settings: Vec<(&'static str, Value)>) -> Vec<(&'static str, Value)> {
    [settings, vec![("over", word("list"))]].concat()
}

#[test]
fn kernels_agree_with_their_references() {
    let shared = support::device();
    for flat in [false, true] {
        for (side, walls) in [(Side::Open, false), (Side::Open, true), (Side::Periodic, false), (Side::Periodic, true)]
        {
            let sizes: &[usize] = if side == Side::Periodic { &[65, 1000] } else { &[1, 2, 63, 65, 1000] };
            for count in sizes {
                agree(&shared, *count, flat, side, walls, &[]);
            }
        }
        for (kernel, support) in [("wendland", 2.6), ("cubic", 3.0)] {
            agree(&shared, 300, flat, Side::Open, true, &[("kernel", word(kernel)), ("support", Number(support))]);
        }
        for side in [Side::Open, Side::Periodic] {
            agree(&shared, 300, flat, side, true, &state());
            agree(&shared, 300, flat, side, true, &listed(state()));
        }
        for count in [1, 2, 63, 65, 1000] {
            agree(&shared, count, flat, Side::Open, true, &listed(Vec::new()));
        }
        agree(&shared, 300, flat, Side::Periodic, false, &listed(Vec::new()));
        agree(&shared, 300, flat, Side::Periodic, true, &listed(surface()));
        agree(&shared, 300, flat, Side::Open, true, &surface());
        agree(
            &shared,
            300,
            flat,
            Side::Open,
            true,
            &[("gamma", Number(2.0)), ("negative_pressure", Value::Flag(false))],
        );
    }
}
