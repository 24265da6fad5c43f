//! Every kernel of a pool with a jet and drains against its twin.

use std::collections::BTreeSet;

use motes::Simulation;
use motes::kernel::Backend;
use motes::lockstep::compare;
use motes::settings::Value;

use crate::ledger::drains;
use crate::support::{self, machines};
use crate::{fluid_with, pool};

#[test]
fn kernels_agree_with_their_twins() {
    let shared = support::device();
    for (name, machine) in machines::machines(&shared).into_iter().filter(|(name, _)| !name.contains("layers")) {
        let mut setup = pool(drains());
        // Those who live are fewer than their ids: who is dead came first.
        setup.forces[1] = fluid_with(&[("tension", Value::Number(0.3)), ("adhesion", Value::Number(0.2))]);
        let count = u32::try_from(setup.particles.len()).expect("few");
        let mut gpu = machines::gpu(&shared, setup.particles.len());
        gpu.pretend(machine);
        let plans = setup.plans(machine).expect("plans");
        let mut simulation = Simulation::on(gpu, &setup).expect("a run");
        let mut changed = BTreeSet::new();
        // A row leaves every 6.6 steps: some of these ends see one.
        for _ in 0..9 {
            simulation.step(6).expect("steps");
            let gpu = simulation.backend();
            gpu.compile(&plans.step).expect("a plan");
            // A step of the plan, kernel by kernel; the clock goes on.
            for verdict in pollster::block_on(compare(gpu, &plans.step, count)).expect("verdicts") {
                assert!(verdict.sound(), "{name}: {verdict:?}");
                if verdict.changed {
                    changed.insert(verdict.kernel);
                }
            }
        }
        for kernel in ["bear", "guide", "drain 1", "fluid state", "fluid density", "fluid pressure", "fluid normals", "fluid tension", "solid"] {
            assert!(changed.contains(kernel), "{name}: {kernel} of {changed:?}");
        }
    }
}
