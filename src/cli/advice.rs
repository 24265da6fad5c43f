//! What one should know of a scene before it runs.

use glam::DVec4;
use motes::forces::{Law, Over, Problem};
use motes::kernel::{ACCELERATION, Access, Array, Host, Kernel, Machine, POSITION, Pass, Plan, Twin, VELOCITY, World};
use motes::scene::Scene;
use motes::{Bounds, Error, Setup};

/// Whether a law does something else at another time: its twin says so for a particle at rest.
fn depends_on_time(twin: &Twin) -> Result<bool, Error> {
    let at = |time: f64, step: u32| {
        let mut host = Host::default();
        host.insert(POSITION.name, Array::Vec4(vec![DVec4::new(0.31, -0.23, 0.17, 1.3)]));
        host.insert(VELOCITY.name, Array::Vec4(vec![DVec4::ZERO]));
        host.insert(ACCELERATION.name, Array::Vec4(vec![DVec4::ZERO]));
        host.set_world(World { time, dt: 1.0, step, count: 1, bounds: Bounds::default() });
        twin(&host).map(|()| host.get(ACCELERATION.name))
    };
    Ok(at(0.0, 0)? != at(0.7, 3)?)
}

/// Fields that a shader of a user may read: what a simulation has, and what the file itself writes.
const FIELDS: &[&str] = &["position", "velocity", "acceleration", "species", "alarm"];

/// A name in a user's file that nobody fills is a slip of the pen.
fn strangers(kernel: &Kernel) -> Result<(), Error> {
    let theirs = |pass: &&Pass| !pass.shader.trusted();
    for pass in kernel.passes.iter().filter(theirs) {
        let file = pass.shader.sources().iter().find(|s| !s.ours).map_or("", |s| &s.file);
        for (name, _) in pass.bindings().filter(|(_, b)| b.access == Access::Read) {
            let written = kernel.bindings().any(|(field, b)| b.access == Access::Write && field == name);
            if FIELDS.contains(&name) || written {
                continue;
            }
            let near =
                FIELDS.iter().min_by_key(|field| strsim::damerau_levenshtein(field, name)).unwrap_or(&"position");
            let message = format!(
                "{file}: nobody fills the field `{name}`; did you mean `{near}`? There are {}",
                FIELDS.join(", ")
            );
            return Err(Error::Shader { message });
        }
    }
    Ok(())
}

/// Whether every force keeps the energy, and whether every force keeps the momentum.
pub fn conserved(setup: &Setup) -> Result<(bool, bool), Error> {
    let (mut energy, mut momentum) = (true, true);
    for law in setup.forces.iter().flat_map(|force| force.laws()) {
        momentum &= law.reciprocal;
        energy &= law.over == Over::Each || law.reciprocal;
        energy &= match &law.twin {
            Some(twin) => !depends_on_time(twin)?,
            None => false,
        };
        energy &= !law.kernel(&Problem::new(1, MACHINE))?.names("velocity");
    }
    // Who holds a speed takes energy and momentum, or gives some.
    let mut limits = Plan::default();
    for force in &setup.forces {
        force.limit(&mut limits, &Problem::new(1, MACHINE))?;
    }
    Ok((energy && limits.order.is_empty(), momentum && limits.order.is_empty()))
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
        let kernel = law.kernel(&Problem::new(1, MACHINE))?;
        strangers(&kernel)?;
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
    let name = scene.integrator.name;
    for (force, its) in setup.forces.iter().map(|force| (force, force.integrators())).filter(|(_, its)| !its.is_empty()) {
        if !its.contains(&name) {
            let law = force.laws().first().map(|law| law.name.clone()).unwrap_or_default();
            remarks.push(format!("`{law}` is a rule for whole steps: it wants {}, not {name}", its.join(" or ")));
        }
    }
    if name == "forward_euler" && setup.forces.iter().all(|force| !force.integrators().contains(&name)) {
        remarks
            .push("forward_euler gains energy in every step, whatever the step: it is here to show why not".to_owned());
    }
    Ok(remarks)
}
