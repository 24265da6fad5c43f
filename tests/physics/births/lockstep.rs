//! Every kernel of a pool with a jet and drains against its reference.

use std::collections::BTreeSet;

use motes::kernel::{Backend, Machine, Plan};
use motes::lockstep::compare;
use motes::settings::Value;
use motes::sph::DENSITY;
use motes::{Gpu, LIFE, Simulation};

use crate::births::ledger::drains;
use crate::births::{fluid_with, pool};
use crate::support::states::{integrator, word};
use crate::support::{self, machines};

/// So many steps, and one of the plan, kernel by kernel; the clock continues. The kernels that change something.
fn agreed(simulation: &mut Simulation<Gpu>, steps: u32, plan: &Plan, name: &str) -> BTreeSet<String> {
    simulation.step(steps).expect("steps");
    let count = simulation.count();
    let gpu = simulation.backend();
    gpu.compile(plan).expect("a plan");
    let verdicts = pollster::block_on(compare(gpu, plan, count)).expect("verdicts");
    for verdict in &verdicts {
        assert!(verdict.sound(), "{name}: {verdict:?}");
    }
    verdicts.into_iter().filter(|verdict| verdict.changed).map(|verdict| verdict.kernel).collect()
}

#[test]
fn kernels_agree_with_their_references() {
    let shared = support::device();
    for (name, machine) in machines::machines(&shared).into_iter().filter(|(name, _)| !name.contains("layers")) {
        let mut setup = pool(drains());
        // Active particles are fewer than their ids: removed ones came first.
        setup.forces[1] = fluid_with(&[("tension", Value::Number(0.3)), ("adhesion", Value::Number(0.2))]);
        let mut gpu = machines::gpu(&shared, setup.state.len());
        gpu.pretend(machine);
        let plans = setup.plans(machine).expect("plans");
        let mut simulation = Simulation::on(gpu, &setup).expect("a run");
        let mut changed = BTreeSet::new();
        // A row leaves every 6.6 steps: some of these ends see one.
        for _ in 0..9 {
            changed.extend(agreed(&mut simulation, 6, &plans.step, name));
        }
        for kernel in [
            "spawn",
            "guide",
            "drain 1",
            "fluid state",
            "fluid density",
            "fluid pressure",
            "fluid normals",
            "fluid tension",
            "solid",
        ] {
            assert!(changed.contains(kernel), "{name}: {kernel} of {changed:?}");
        }
    }
}

/// Where density is a state, pending particles keep it, and removed ones are in no sum.
#[test]
fn states_of_density_agree_with_their_references() {
    let shared = support::device();
    let mut setup = pool(drains());
    let (continuity, diffusion) = (("density_by", word("continuity")), ("diffusion", Value::Number(0.1)));
    setup.forces[1] = fluid_with(&[continuity, diffusion]);
    let mut simulation = Simulation::on(machines::gpu(&shared, setup.state.len()), &setup).expect("a run");
    let plans = setup.plans(simulation.backend().machine()).expect("plans");
    for _ in 0..4 {
        agreed(&mut simulation, 13, &plans.step, "continuity");
        let density = pollster::block_on(simulation.read(DENSITY)).expect("densities");
        let life = pollster::block_on(simulation.read(LIFE)).expect("lives");
        let of = |word: u32| density.iter().zip(&life).filter(move |(_, life)| **life == word).map(|(rho, _)| *rho);
        // As at rest, until they are spawned; then they are pressed.
        assert!(of(0).all(|rho| rho.to_bits() == 1000.0f32.to_bits()));
        assert!(of(1).any(|rho| (rho - 1000.0).abs() > 1.0));
    }
    let of = pollster::block_on(simulation.population()).expect("a count");
    assert!(of.pending > 0 && of.removed > 0, "{of:?}");
}

/// Where pressure is solved for, active particles alone are: pairs are kept, or found anew.
#[test]
fn solves_for_pressure_agree_with_their_references() {
    let shared = support::device();
    for walks in [false, true] {
        let mut setup = pool(drains());
        setup.forces[1] = fluid_with(&[("solver", word("dfsph")), ("max_iterations", Value::Number(4.0))]);
        setup.integrator = integrator("symplectic_euler");
        let mut gpu = machines::gpu(&shared, setup.state.len());
        if walks {
            let machine = gpu.machine();
            gpu.pretend(Machine { bindable: 0, ..machine });
        }
        let plans = setup.plans(gpu.machine()).expect("plans");
        let mut simulation = Simulation::on(gpu, &setup).expect("a run");
        let mut changed = BTreeSet::new();
        for _ in 0..4 {
            changed.extend(agreed(&mut simulation, 13, &plans.step, if walks { "walks" } else { "pairs" }));
        }
        for kernel in ["fluid response", "fluid begin", "fluid predict", "fluid density push", "fluid finish"] {
            assert!(changed.contains(kernel), "{walks}: {kernel} of {changed:?}");
        }
        let of = pollster::block_on(simulation.population()).expect("a count");
        assert!(of.pending > 0 && of.removed > 0, "{of:?}");
    }
}
