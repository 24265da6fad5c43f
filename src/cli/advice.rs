//! What one should know of a scene before it runs.

use motes::forces::{Law, Over};
use motes::kernel::Machine;
use motes::scene::Scene;
use motes::{Error, Setup};

/// Whether every force keeps the energy, and whether every force keeps the momentum.
pub fn conserved(setup: &Setup) -> Result<(bool, bool), Error> {
    let (mut energy, mut momentum) = (true, true);
    for law in setup.forces.iter().flat_map(|force| force.laws()) {
        momentum &= law.over == Over::Pairs && law.twin.is_some();
        let untwinned = law.twin.is_none();
        energy &= !untwinned && !law.kernel(1, &MACHINE)?.names("velocity");
    }
    Ok((energy, momentum))
}

const MACHINE: Machine = Machine { software: true, subgroup: 0, invocations: 1 };

/// Remarks of the scene itself, and of how its forces and its integrator go together.
pub fn advice(scene: &Scene, setup: &Setup) -> Result<Vec<String>, Error> {
    let mut remarks = scene.remarks.clone();
    let laws: Vec<Law> = setup.forces.iter().flat_map(|force| force.laws()).collect();
    let (order, reduced) = (setup.integrator.order(), setup.integrator.order_with_velocity());
    for law in laws {
        let name = law.name.clone();
        let untwinned = law.twin.is_none();
        let kernel = law.kernel(1, &MACHINE)?;
        if kernel.names("velocity") && reduced < order {
            remarks.push(format!(
                "`{name}` depends on velocity: {} is of order {order} for other forces, and of order {reduced} with it; \
                 midpoint, heun and rk4 keep their order",
                scene.integrator.name
            ));
        }
        if untwinned {
            remarks.push(format!("`{name}` has no f64 twin: nothing checks it, and it needs a device"));
        }
    }
    if scene.integrator.name == "forward_euler" {
        remarks
            .push("forward_euler gains energy in every step, whatever the step: it is here to show why not".to_owned());
    }
    Ok(remarks)
}
