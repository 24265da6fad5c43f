//! Every kernel of an implicit step with springs against its f64 reference.

use motes::forces::Component;
use motes::kernel::Machine;
use motes::lockstep::compare;
use motes::settings::Value;
use motes::{Gpu, Simulation, Solver};

use crate::implicit::cloth::cloth;
use crate::implicit::{ALL, setup};
use crate::support;
use crate::support::states::{force, vector};

fn forces() -> Vec<Box<dyn Component>> {
    vec![
        force("uniform", &[("acceleration", vector(0.3, -0.2, -9.81))]),
        force("spring", &[]),
        force("drag", &[("linear", Value::Number(0.3)), ("quadratic", Value::Number(0.4))]),
    ]
}

#[test]
fn a_step_of_a_cloth() {
    let shared = support::device();
    let machines = [
        Machine { software: true, subgroup: 0, invocations: 256, ..Machine::HOST },
        Machine { software: false, subgroup: 0, invocations: 1 << 18, ..Machine::HOST },
    ];
    for name in ALL {
        for machine in machines {
            let mut particles = cloth(19, 40.0);
            for link in &mut particles.links.springs {
                link.damping = 0.7;
            }
            // A particle without mass is solved alone.
            let last = particles.len() - 1;
            particles.mass_mut()[last] = 0.0;
            let count = u32::try_from(particles.len()).expect("few");
            // So few iterations that much is left for the second solve: what is left is a difference of impulses, and where
            // they cancel, so do their digits.
            let solver = Solver { tolerance: 1e-5, iterations: 3, solves: 2 };
            let setup = setup(&particles, forces(), name, 0.07, solver);
            let mut gpu = Gpu::new(&shared.found.device, &shared.found.queue, count).expect("a GPU");
            gpu.pad(5);
            gpu.pretend(machine);
            let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
            simulation.step(3).expect("steps");
            let plan = setup.plans(machine).expect("plans").step;
            let verdicts = pollster::block_on(compare(simulation.backend(), &plan, count)).expect("a comparison");
            for kernel in ["rows", "drag rows", "begin", "product", "advance", "update", "reach", "report"] {
                let its: Vec<_> = verdicts
                    .iter()
                    .filter(|v| v.kernel == kernel || v.kernel.starts_with(&format!("{kernel} ")))
                    .collect();
                assert!(its.iter().any(|v| v.changed), "{name}: {kernel} changes nothing, or is not there");
            }
            for verdict in &verdicts {
                // What a solve of Newton's method left is the difference of impulses that are up to a hundred times as
                // large, with their roundings of 6e-8: ten times what is allowed of the change.
                let later = !name.starts_with("linear") && verdict.kernel.starts_with("begin");
                let most = if later { 10.0 } else { 1.0 };
                assert!(verdict.worst <= most && !verdict.spilled, "{name}, {machine:?}: {verdict:?}");
            }
        }
    }
}
