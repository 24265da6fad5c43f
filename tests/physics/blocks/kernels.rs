//! Every kernel of a step with block time steps against its reference, in lockstep, on every kind of machine.

use motes::Simulation;
use motes::kernel::{Backend, Plan};
use motes::lockstep::compare;

use super::{cusp, gravity, setup, steps};
use crate::support::{self, agrees, machines};

#[test]
fn every_kernel_agrees_with_its_reference() {
    let shared = support::device();
    for (over, alpha) in [("pairs", 0.0), ("tree", 0.0), ("tree", 0.01)] {
        let all = if over == "pairs" { machines::machines(&shared) } else { machines::walkers(&shared) };
        for (name, machine) in all {
            for (count, seed) in [(if over == "tree" { 2200 } else { 1000 }, 1), (333, 2)] {
                let setup =
                    setup(cusp(count, 0.03, seed), vec![gravity(1.0, 0.004, over, alpha)], 0.01, steps(5, 0.02));
                let mut gpu = machines::gpu(&shared, count);
                gpu.pretend(machine);
                let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
                simulation.step(1).expect("a step");
                let plan: Plan = setup.plans(machine).expect("plans").step;
                let count = u32::try_from(count).expect("few");
                let gpu = simulation.backend();
                gpu.compile(&plan).expect("a program");
                let verdicts = pollster::block_on(compare(gpu, &plan, count)).expect("verdicts");
                let parts = verdicts.iter().filter(|verdict| verdict.kernel == "next part").count();
                assert!(parts >= 8, "{over}, {name}: {parts} parts");
                for verdict in &verdicts {
                    assert!(agrees(verdict), "{over}, {name}, {count}: {verdict:?}");
                }
            }
        }
    }
}
