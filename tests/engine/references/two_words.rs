//! Forces of positions of two words, far from the origin.

use super::{judge, verdicts};
use crate::support::machines::{gpu, machines};
use crate::support::states::{force, integrator, word};
use glam::DVec3;
use motes::integrators::Precise;
use motes::kernel::Precision;
use motes::settings::Value;
use motes::{Setup, Simulation};

/// A cloud at some 10⁴ of its radii, where single precision has 10⁻³ of them.
fn far(count: usize, precision: Precision) -> Setup {
    let mut state = crate::support::cloud(count, 7);
    state.position_mut().iter_mut().for_each(|x| *x += DVec3::new(1e4, -2e4, 1.5e4));
    let tree = [("over", word("tree")), ("theta", Value::Number(0.6)), ("softening", Value::Number(0.3))];
    let forces =
        vec![force("gravity", &[("softening", Value::Number(0.1))]), force("gravity", &tree), force("spring", &[])];
    let integrator = Box::new(Precise { integrator: integrator("leapfrog"), precision });
    Setup { integrator, ..Setup::new(state, forces, 1e-4) }
}

#[test]
fn forces_of_both_words() {
    let shared = crate::support::device();
    for (name, machine) in machines(&shared) {
        for count in [1, 2, 65, 333] {
            let setup = far(count, Precision::DoubleSingle);
            let mut gpu = gpu(&shared, count);
            gpu.pretend(machine);
            let plan = setup.plans(machine).expect("plans").step;
            let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
            simulation.step(2).expect("two steps");
            let idle = |v: &motes::lockstep::Verdict| v.field == "alarm" || count == 1 || v.kernel.contains("key");
            judge(&verdicts(simulation.backend(), &plan, count, &name), count, &name, idle);
        }
    }
}
