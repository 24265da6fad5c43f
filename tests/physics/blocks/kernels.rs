//! Every kernel of a step with block time steps against its reference, in lockstep, on every kind of machine.

use std::time::Duration;

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
                // It is of particles that are due alone.
                let file =
                    if over == "pairs" { "shaders/visit/targets_due.wgsl" } else { "shaders/visit/tree_due.wgsl" };
                let gravity = plan.kernels.iter().find(|kernel| kernel.name == "gravity").expect("gravity");
                let sources = gravity.passes.iter().flat_map(|pass| pass.shader.sources());
                assert!(sources.into_iter().any(|source| source.file == file), "{over}, {name}");
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

/// Of 1024 parts that a plan has room for, those that are not needed are not submitted where submissions are short; bits are the same.
#[test]
fn a_loop_is_cut_short() {
    let shared = support::device();
    let setup = |levels| setup(cusp(300, 0.1, 2), vec![gravity(1.0, 0.01, "pairs", 0.0)], 0.02, steps(levels, 0.0));
    let run = |levels, target: Duration| {
        let mut gpu = machines::gpu(&shared, 300);
        gpu.limit_submissions(target, Duration::from_mins(1));
        let mut simulation = Simulation::on(gpu, &setup(levels)).expect("a simulation");
        simulation.step(3).expect("steps");
        let bytes = super::bytes(&mut simulation);
        let levels = super::levels(&mut simulation);
        (bytes, levels.parts, simulation.backend().submissions())
    };
    let (whole, parts, few) = run(10, Duration::from_millis(80));
    let (cut, again, many) = run(10, Duration::from_nanos(1));
    let (shorter, ..) = run(6, Duration::from_nanos(1));
    assert!(whole == cut && whole == shorter && parts == again);
    assert!(parts < 3 * 64, "{parts}");
    // Each part has fewer than 20 dispatches; all 3072 would have more than 30 000.
    assert!(few < many && many < 20 * parts + 600, "{few} and {many} submissions for {parts} parts");
}
