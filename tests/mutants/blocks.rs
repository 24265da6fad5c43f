//! Stages of block time steps: every kernel of a step in the states to which its parts lead, and laws where some targets are due.

use std::cell::RefCell;
use std::rc::Rc;

use glam::DVec3;
use motes::integrators::BlockLeapfrog;
use motes::kernel::{Array, BLOCK_CLOCK, BLOCK_CLOCK_WORDS, Backend, BlockSteps, Machine};
use motes::settings::Value;
use motes::{Bounds, Gpu, Setup, Simulation, Solver, State};

use crate::stages::{Device, FEW, Stage, next, put};
use crate::support::equivalents::{Equivalent, same};
use crate::support::machines::{alone, machines, walkers};
use crate::support::states::{force, word};
use crate::support::{Random, Shared};

const BEHIND: &str = "what is behind the last particle is read by none";

pub const EQUIVALENT: &[Equivalent] = &[
    same("block_level", "while steps > 1.0", ">", ">=", "no particle requires just a power of two"),
    same("block_level", "const TOO_MANY", "31u", "32u", "no particle requires so many"),
    same("targets_due", "fn target_at", "1u) - 1u", "1u) + 1u", BEHIND),
];

/// Particles about the origin in shells from 0.02 to 1, which a heavy one there attracts, at rest or on their way.
fn shells() -> State {
    let mut random = Random::new(47);
    let mut state = State::default();
    let single = |v: DVec3| v.as_vec3().as_dvec3();
    state.push(DVec3::ZERO, DVec3::ZERO, 1.0, 0.01);
    for k in 1..FEW {
        let radius = 0.02 + 0.98 * (k as f64 / FEW as f64);
        let place = radius * random.vector().normalize();
        let speed = (1.0 / radius).sqrt() * (0.3 + 0.7 * random.next().abs());
        state.push(single(place), single(speed * random.vector().normalize()), 0.3 / FEW as f64, 0.001);
    }
    state
}

/// A case: the visit and α of gravity, the largest level, ε, and whether all take the shortest step.
#[derive(Clone, Copy)]
struct Case(&'static str, f64, u32, f64, bool);

fn setup(Case(over, alpha, levels, length, shared): Case) -> Setup {
    let own = length == 0.0;
    let mut all = vec![("g", Value::Number(1.1)), ("softening", Value::Number(0.02)), ("over", word(over))];
    all.extend([("alpha", Value::Number(alpha)), ("theta", Value::Number(0.8))]);
    let mut state = shells();
    if own {
        all.extend([("individual_softening", Value::Flag(true)), ("kernel", word("spline"))]);
        let lengths = (0..FEW).map(|k| [0.02, 0.005, 0.01][k % 3]).collect();
        state.set("softening_length", Array::Float(lengths)).expect("a column");
    }
    let steps = BlockSteps { levels, eta: 0.025, length, mass: 0.0, shared };
    Setup {
        state,
        forces: vec![force("gravity", &all)],
        integrator: Box::new(BlockLeapfrog(steps)),
        dt: 0.04,
        bounds: Bounds::default(),
        solver: Solver::default(),
    }
}

/// The kernels of the step after the first, some of those whose files begin in a way, each amid what those before it left.
fn step(
    device: &Device,
    name: &str,
    machine: Machine,
    case: Case,
    (first, most): (&str, usize),
    stages: &mut Vec<Stage>,
) {
    let setup = setup(case);
    let mut gpu = Gpu::new(&device.0, &device.1, u32::try_from(FEW).expect("few")).expect("a GPU");
    gpu.pad(5);
    gpu.pretend(machine);
    let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
    simulation.step(1).expect("a step");
    let mut clock = [0u32; BLOCK_CLOCK_WORDS];
    // The lower words of the counts are about to be full; no particle has required too much.
    clock[4..].copy_from_slice(&[u32::MAX, 3, 4, u32::MAX, 5, u32::MAX - 700, 6]);
    put(&mut simulation, BLOCK_CLOCK, &clock);
    let plan = setup.plans(machine).expect("plans").step;
    let shared = Rc::new(RefCell::new(simulation));
    let (mut walk, mut staged) = (plan.walk(), std::collections::BTreeMap::new());
    while let Some(kernel) = next(&mut walk, &shared) {
        let own = alone(kernel.clone());
        let program = shared.borrow_mut().backend().compile(&own).expect("a program");
        let files = kernel.passes.iter().flat_map(|pass| pass.shader.sources());
        if files.into_iter().any(|source| source.file.contains(first)) {
            let times = staged.entry(kernel.name.clone()).or_insert(0);
            *times += 1;
            if *times <= most {
                stages.push(Stage::amid(&format!("{} {times}, {name}", kernel.name), &shared, own));
            }
        }
        shared.borrow_mut().backend().run(&program, 1).expect("a run");
    }
}

pub fn all(shared: &Shared, device: &Device, stages: &mut Vec<Stage>) {
    let host = Machine::HOST;
    step(device, "of its own", host, Case("pairs", 0.0, 4, 0.02, false), ("integrators/block_", 12), stages);
    step(device, "shared", host, Case("pairs", 0.0, 4, 0.02, true), ("integrators/block_", 3), stages);
    step(device, "too long", host, Case("pairs", 0.0, 2, 0.002, false), ("integrators/block_", 3), stages);
    step(device, "of own length", host, Case("pairs", 0.0, 5, 0.0, false), ("integrators/block_", 3), stages);
    for (name, machine) in machines(shared) {
        step(device, name, machine, Case("pairs", 0.0, 4, 0.02, false), ("_due", 3), stages);
        step(device, name, machine, Case("pairs", 0.0, 4, 0.02, false), ("due_", 3), stages);
    }
    for (name, machine) in walkers(shared) {
        for alpha in [0.0, 0.01] {
            step(device, name, machine, Case("tree", alpha, 4, 0.02, false), ("due", 3), stages);
        }
    }
}
