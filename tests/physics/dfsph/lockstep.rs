//! Every kernel against its reference, on the device's own inputs.

use std::collections::BTreeMap;

use glam::Vec4;
use motes::kernel::{Backend, Machine};
use motes::lockstep::compare;
use motes::settings::Value;
use motes::{Simulation, VELOCITY};

use crate::dfsph::{SPACING, Tank};
use crate::support::machines::gpu;
use crate::support::{self, Random};

#[test]
fn device_and_references_solve_alike() {
    let shared = support::device();
    // Pairs are kept where there is room for them.
    for (flat, walks) in [(true, false), (false, false), (false, true)] {
        let tank = Tank::new(if flat { [9, 11] } else { [5, 6] }, flat, 0.2);
        let count = tank.particles.len();
        let mut gpu = gpu(&shared, count);
        if walks {
            let machine = gpu.machine();
            gpu.pretend(Machine { bindable: 0, ..machine });
        }
        let settings = [("viscosity", Value::Number(0.003)), ("max_iterations", Value::Number(6.0))];
        let setup = tank.setup(&settings, 0.004);
        let plans = setup.plans(gpu.machine()).expect("plans");
        let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
        let mut random = Random::new(5);
        let velocity: Vec<Vec4> =
            (0..count).map(|_| (random.vector() * SPACING * 10.0).as_vec3().extend(0.0)).collect();
        let mut seen = BTreeMap::<String, bool>::new();
        for (pass, plan) in [&plans.start, &plans.step, &plans.step].into_iter().enumerate() {
            if pass == 1 {
                let flatten = |v: &Vec4| if flat { v.with_z(0.0) } else { *v };
                simulation.write(VELOCITY, &velocity.iter().map(flatten).collect::<Vec<_>>()).expect("velocities");
            }
            let verdicts = pollster::block_on(compare(simulation.backend(), plan, count as u32)).expect("a run");
            for verdict in verdicts.iter().filter(|v| v.kernel.starts_with("fluid")) {
                assert!(verdict.sound(), "{flat} {walks} {pass}: {verdict:?}");
                *seen.entry(format!("{} of {}", verdict.field, verdict.kernel)).or_default() |= verdict.changed;
            }
        }
        let idle: Vec<_> = seen.iter().filter(|(name, changed)| !**changed && !name.starts_with("alarm")).collect();
        assert!(idle.is_empty(), "nothing happens to {idle:?}");
        assert!(seen.len() > 20, "{seen:?}");
    }
}
