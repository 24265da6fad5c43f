//! Stages of block time steps: every kernel of a step in the states to which its parts lead, and laws where some targets are due.

use std::cell::RefCell;
use std::rc::Rc;

use glam::{DVec3, Vec4};
use motes::integrators::BlockLeapfrog;
use motes::kernel::{ACCELERATION, Array, BLOCK_CLOCK, BLOCK_CLOCK_WORDS, Backend, BlockSteps, DUE, Field, Machine};
use motes::settings::Value;
use motes::{Bounds, Gpu, Setup, Simulation, Solver, State};

use crate::stages::{Device, FEW, Stage, moving, next, put};
use crate::support::equivalents::{Equivalent, same};
use crate::support::machines::{alone, machines, walkers};
use crate::support::states::{force, word};
use crate::support::{Random, Shared};

const BEHIND: &str = "what is behind the last particle is read by none";

const FEW_GROUPS: &str = "so few groups are one workgroup; tests/physics/blocks/kernels.rs has more";
const ALIKE: &str = "all invocations would write the same";
const NEEDLESS: &str = "more is loaded or evaluated than need be, and not delivered";

pub const EQUIVALENT: &[Equivalent] = &[
    same("block_level", "return select(0.0, most", ">", ">=", "what is no number is not above 1 either"),
    same("block_begin", "if i == 0u", "==", "!=", ALIKE),
    same("block_begin", "if i == 0u", "0u", "1u", ALIKE),
    same("tree/due", "let g = folded", "*", "/", FEW_GROUPS),
    same("tree/due", "if first < world.count", "<", "<=", "the demand of what is no group is read by none"),
    same("due_count", "if i < world.count", "<", "<=", BEHIND),
    same("targets_due", "fn target_at", "-", "+", BEHIND),
    same("targets_due", "fn target_at", "1u", "2u", BEHIND).sometimes(),
    same("targets_due", "fn sources_of", "0u", "1u", NEEDLESS),
    same("targets_due", "fn sources_of", "<", "<=", NEEDLESS),
];

/// What particles require together.
const WANTED: Field<u32> = Field::new("block_wanted");

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

/// A case: the visit and α of gravity, the largest level, ε, the mass above which particles take the shortest step, and whether all do.
#[derive(Clone, Copy)]
struct Case(&'static str, f64, u32, f64, f64, bool);

fn setup(Case(over, alpha, levels, length, mass, shared): Case) -> Setup {
    let own = length == 0.0;
    let mut all = vec![("g", Value::Number(1.1)), ("softening", Value::Number(0.02)), ("over", word(over))];
    all.extend([("alpha", Value::Number(alpha)), ("theta", Value::Number(0.8))]);
    let mut state = shells();
    if own {
        all.extend([("individual_softening", Value::Flag(true)), ("kernel", word("spline"))]);
        let lengths = (0..FEW).map(|k| [0.02, 0.005, 0.01][k % 3]).collect();
        state.set("softening_length", Array::Float(lengths)).expect("a column");
    }
    let steps = BlockSteps { levels, eta: 0.025, length, mass, shared };
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
    let (setup, shared) = (setup(case), case.5);
    let mut gpu = Gpu::new(&device.0, &device.1, u32::try_from(FEW).expect("few")).expect("a GPU");
    gpu.pad(5);
    gpu.pretend(machine);
    let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
    simulation.step(1).expect("a step");
    // The lower words of the counts are about to be full, or zero; no particle has required too much.
    let counts = if shared { [0; 4] } else { [u32::MAX, 5, u32::MAX - 700, 6] };
    let mut clock = [0u32; BLOCK_CLOCK_WORDS];
    clock[4..7].copy_from_slice(&[u32::MAX, 3, 4]);
    clock[7..].copy_from_slice(&counts);
    put(&mut simulation, BLOCK_CLOCK, &clock);
    let plan = setup.plans(machine).expect("plans").step;
    let amid = Rc::new(RefCell::new(simulation));
    let (mut walk, mut staged) = (plan.walk(), std::collections::BTreeMap::new());
    while let Some(kernel) = next(&mut walk, &amid) {
        let own = alone(kernel.clone());
        let program = amid.borrow_mut().backend().compile(&own).expect("a program");
        let files = kernel.passes.iter().flat_map(|pass| pass.shader.sources());
        if files.into_iter().any(|source| source.file.contains(first)) {
            let times = staged.entry(kernel.name.clone()).or_insert(0);
            *times += 1;
            if *times <= most {
                stages.push(Stage::amid(&format!("{} {times}, {name}", kernel.name), &amid, own));
            }
        }
        amid.borrow_mut().backend().run(&program, 1).expect("a run");
    }
}

/// A step begins, whatever was before; and accelerations of all magnitudes, some along axes.
fn given(device: &Device, stages: &mut Vec<Stage>) {
    let kernels = setup(Case("pairs", 0.0, 4, 1e-24, 0.0, false)).plans(Machine::HOST).expect("plans").step.kernels;
    for kernel in kernels {
        let entry = kernel.passes[0].shader.reflection().entry.clone();
        if entry != "block_begin" && entry != "block_level" {
            continue;
        }
        let (mut simulation, plan) = (moving(device, FEW, Some(Machine::HOST)), alone(kernel));
        simulation.backend().compile(&plan).expect("a good plan");
        let is_level = entry == "block_level";
        let mut clock = [9u32; BLOCK_CLOCK_WORDS];
        clock[1] = if is_level { 8 } else { 5 };
        put(&mut simulation, BLOCK_CLOCK, &clock);
        put(&mut simulation, DUE, &(0..FEW).map(|k| u32::from(is_level || k % 3 == 1)).collect::<Vec<_>>());
        put(&mut simulation, WANTED, &if is_level { [0, u32::MAX, 0, 0] } else { [5, 6, 7, 8] });
        if is_level {
            // ε = 1e-24 and dt = 0.04: from 3e-23 on they require parts.
            let of = |k: usize| -> Vec4 {
                let a = 2e-23 * (1.0 + (k % 97) as f32);
                match k % 5 {
                    0 => Vec4::new(0.0, a, 0.3 * a, 1.0),
                    1 => Vec4::new(-a, 0.0, 0.7 * a, 1.0),
                    2 => Vec4::new(0.2 * a, -0.5 * a, 0.0, 1.0),
                    // Just as many levels as there are: 4³ < 3.2e22 · 4.7e-21 < 4⁴.
                    3 if k == 3 => Vec4::new(0.0, 0.0, 4.7e-21, 1.0),
                    3 => Vec4::new(0.0, 0.0, 0.0, 1.0),
                    _ if k == 4 => Vec4::new(1e38, 0.0, 0.0, 1.0),
                    _ => Vec4::new(0.0, a, 0.0, 1.0),
                }
            };
            put(&mut simulation, ACCELERATION, &(0..FEW).map(of).collect::<Vec<_>>());
        }
        stages.push(Stage::of(&format!("{entry}, given"), simulation, plan));
    }
}

/// Groups of targets of which only the first is due: those before them are not.
fn firsts(device: &Device, stages: &mut Vec<Stage>) {
    let plan = setup(Case("tree", 0.0, 4, 0.02, 0.0, false)).plans(Machine::HOST).expect("plans").step;
    let kernel = plan.kernels.into_iter().find(|kernel| kernel.name.starts_with("due groups")).expect("a kernel");
    let name = kernel.passes[0].field("tree_id").to_owned();
    let (mut simulation, plan) = (moving(device, FEW, Some(Machine::HOST)), alone(kernel));
    simulation.backend().compile(&plan).expect("a good plan");
    let ids: Vec<u32> = (0..).take(FEW).collect();
    simulation.backend().write_bytes(&name, 0, bytemuck::cast_slice(&ids)).expect("ids");
    put(&mut simulation, DUE, &(0..FEW).map(|k| u32::from(k % 96 == 64)).collect::<Vec<_>>());
    stages.push(Stage::of("due groups, of a first", simulation, plan));
}

pub fn all(shared: &Shared, device: &Device, stages: &mut Vec<Stage>) {
    let host = Machine::HOST;
    given(device, stages);
    firsts(device, stages);
    step(device, "of its own", host, Case("pairs", 0.0, 6, 0.3, 0.0, false), ("integrators/block_", 20), stages);
    step(device, "shared", host, Case("pairs", 0.0, 4, 0.02, 0.0, true), ("integrators/block_", 3), stages);
    // The heavy one is just not heavier.
    step(device, "too long", host, Case("pairs", 0.0, 5, 0.002, 1.0, false), ("integrators/block_", 12), stages);
    step(device, "of own length", host, Case("pairs", 0.0, 5, 0.0, 0.0, false), ("integrators/block_", 3), stages);
    for (name, machine) in machines(shared) {
        step(device, name, machine, Case("pairs", 0.0, 4, 0.02, 0.0, false), ("_due", 3), stages);
        step(device, name, machine, Case("pairs", 0.0, 4, 0.02, 0.0, false), ("due_", 3), stages);
    }
    for (name, machine) in walkers(shared) {
        for alpha in [0.0, 0.01] {
            step(device, name, machine, Case("tree", alpha, 4, 0.02, 0.0, false), ("visit/tree_due", 3), stages);
            step(device, name, machine, Case("tree", alpha, 4, 0.02, 0.0, false), ("tree/due", 12), stages);
        }
    }
}
