//! Stages of fluids: clouds with walls in them, in space and in the plane, on devices with and without subgroups.

use std::cell::RefCell;
use std::rc::Rc;

use glam::{DVec3, DVec4};
use motes::integrators::Step;
use motes::kernel::{ACCELERATION, Backend, Kernel, Machine, Problem, Source, World};
use motes::neighbors::Grid;
use motes::settings::Value;
use motes::visit::{Candidate, Law, Outcome, Particle, Search};
use motes::{Gpu, Setup, Side, Simulation};

use crate::stages::{Device, FEW, Stage};
use crate::support::equivalents::{Equivalent, same};
use crate::support::fluids::{SPACING, bounds, cloud, fluid};
use crate::support::machines::{alone, subgroups_of_eight};
use crate::support::states::{integrator, vector, word};
use crate::support::{Random, Shared, limited};

use Value::{Flag, Number};

const NOT_ALONG: &str = "it divides a product with no distance, which is nothing";

pub const EQUIVALENT: &[Equivalent] = &[
    same("sph/cubic", "return select(2.0", "<=", "<", "both halves have one value where they meet"),
    same("sph/tension", "const NOTHING", "1e-30", "1.5000000000000001e-30", "no particle is as near as that"),
    same("sph/tension", "let pull = ", "<=", "<", "both halves have one value where they meet"),
    same("sph/pressure", "let central = ", "1.0", "1.5", NOT_ALONG),
    same(
        "sph/pressure",
        "let central = ",
        ">",
        ">=",
        "no two particles are at one place; tests/physics/fluids/turning.rs has two",
    ),
    same("sph/cubic", "return select(-6.0", "<=", "<", "both halves have one value where they meet"),
    same("sph/dense.wgsl", "return Particle(", "0.0", "1.0", "its pressure is not read"),
    same(
        "sph/wall_pressure",
        "let p = ",
        "1e-30",
        "1.5000000000000001e-30",
        "no particle is so near to the rim that the kernel is as small",
    ),
    same("sph/wall_state", "if k < world.count", "<", "<=", "behind the last slot stands no wall"),
];

const LANES: Machine = Machine { software: false, subgroup: 0, invocations: 1 << 18, ..Machine::HOST };
const EIGHT: Machine = Machine { software: true, subgroup: 8, invocations: 256, ..Machine::HOST };

struct Case {
    name: &'static str,
    flat: bool,
    side: Side,
    walls: bool,
    settings: Vec<(&'static str, Value)>,
}

fn cases() -> Vec<Case> {
    let case = |name, flat, side, walls, settings| Case { name, flat, side, walls, settings };
    vec![
        case("in space", false, Side::Periodic, true, vec![("viscosity_form", word("morris"))]),
        case("in the plane", true, Side::Open, true, vec![("kernel", word("wendland")), ("support", Number(2.6))]),
        case("a surface", true, Side::Open, true, vec![("tension", Number(0.7)), ("adhesion", Number(900.0))]),
        case(
            "a surface in space",
            false,
            Side::Periodic,
            true,
            vec![("tension", Number(0.3)), ("adhesion", Number(1300.0))],
        ),
        case("a state", false, Side::Open, true, state(0.7)),
        case("a state without walls", true, Side::Periodic, false, state(0.0)),
        case(
            "without walls",
            true,
            Side::Open,
            false,
            vec![("negative_pressure", Flag(false)), ("gamma", Number(2.0))],
        ),
        case("in space, listed", false, Side::Periodic, true, listed(vec![("viscosity_form", word("morris"))])),
        case(
            "a surface, listed",
            true,
            Side::Open,
            true,
            listed(vec![("tension", Number(0.7)), ("adhesion", Number(900.0))]),
        ),
        case("a state, listed", false, Side::Open, true, listed(state(0.7))),
    ]
}

/// The same over a kept list.
fn listed(settings: Vec<(&'static str, Value)>) -> Vec<(&'static str, Value)> {
    [settings, vec![("over", word("list")), ("skin", Number(0.05))]].concat()
}

/// Density as a state, walls with a pressure of their own, and XSPH.
fn state(depth: f64) -> Vec<(&'static str, Value)> {
    vec![
        ("density_by", word("continuity")),
        ("diffusion", Number(0.2)),
        ("xsph", Number(0.3)),
        ("weight", vector(0.3, -0.9, depth)),
        ("walls", word("extrapolate")),
        ("wall_mass", word("lattice")),
        ("negative_pressure", Flag(false)),
        // Below 1, so that no particle is taken for a wall.
        ("density", Number(0.7)),
    ]
}

/// A simulation a step on its way, whose grid is that of where it is, and how it moves there.
pub fn simulation(device: &Device, machine: Machine, setup: &Setup) -> Simulation<Gpu> {
    let mut gpu = Gpu::new(&device.0, &device.1, u32::try_from(FEW).expect("few")).expect("a GPU");
    gpu.pad(5);
    gpu.pretend(machine);
    let mut simulation = Simulation::on(gpu, setup).expect("a simulation");
    simulation.step(1).expect("a step");
    let (problem, list) = (setup.problem(machine).expect("a problem"), setup.plans(machine).expect("plans").list);
    let mut step = Step::new(&setup.forces, problem.listed(list));
    step.evaluate();
    let program = simulation.backend().compile(&step.finished().expect("a plan")).expect("a program");
    simulation.backend().run(&program, 1).expect("an evaluation");
    simulation
}

/// Other numbers than before in what a kernel makes anew, and in what wall particles receive.
fn forget(simulation: &mut Simulation<Gpu>, kernel: &Kernel) {
    let mut random = Random::new(41);
    let anew = |name: &str| match kernel.name.as_str() {
        "fluid state" => name.starts_with("flow"),
        "fluid normals" => name.starts_with("normal"),
        "fluid density" | "fluid density rate" => kernel.writes().iter().any(|other| other == name),
        other => other.contains("wall") && name.starts_with("wall_"),
    };
    let plan = alone(kernel.clone());
    for name in plan.fields(1).into_keys().filter(|name| anew(name)) {
        let gpu = simulation.backend();
        let words: Vec<f32> = (0..gpu.size(&name) / 4).map(|_| random.narrow()).collect();
        gpu.write_bytes(&name, 0, bytemuck::cast_slice(&words)).expect("a field");
    }
}

pub fn all(shared: &Shared, device: &Device, stages: &mut Vec<Stage>) {
    // A list of neighbours has more layers than few workgroups allow.
    let large = &pollster::block_on(limited(shared, |_| {}));
    let mut machines = vec![LANES];
    if subgroups_of_eight(shared) {
        machines.push(EIGHT);
    }
    for (place, machine) in machines.iter().enumerate() {
        // A list is the same, however its rows were found.
        for case in cases().into_iter().filter(|case| place == 0 || !case.name.ends_with("listed")) {
            let device = if case.name.ends_with("listed") { large } else { device };
            let bounds = bounds(FEW, case.flat, case.side);
            let setup = Setup {
                state: cloud(FEW, case.flat, case.walls),
                forces: vec![fluid(&case.settings)],
                // Its drifts are parts of a step.
                integrator: integrator("pefrl"),
                dt: 0.003,
                bounds,
                solver: motes::Solver::default(),
            };
            let plans = setup.plans(*machine).expect("plans");
            let kernels: Vec<_> = [plans.start, plans.step].into_iter().flat_map(|plan| plan.kernels).collect();
            let mut seen: Vec<String> = Vec::new();
            for kernel in kernels.into_iter().filter(|kernel| kernel.name.starts_with("fluid")) {
                if seen.contains(&kernel.name) {
                    continue;
                }
                seen.push(kernel.name.clone());
                let name = format!("{}, {}, {place}", kernel.name, case.name);
                let mut simulation = simulation(device, *machine, &setup);
                forget(&mut simulation, &kernel);
                // Near neighbours of a surface pull by small differences: rounding of the inputs is worth 1.6 of the limit.
                let slack = if kernel.name == "fluid tension" { 2.0 } else { 1.0 };
                stages.push(Stage::of(&name, simulation, alone(kernel)).slack(slack));
            }
        }
        seen(device, *machine, stages);
    }
}

/// A search that reads every member of a fluid's particle.
fn seen(device: &Device, machine: Machine, stages: &mut Vec<Stage>) {
    let all = bounds(FEW, false, Side::Periodic);
    let setup = Setup {
        state: cloud(FEW, false, true),
        forces: vec![fluid(&[])],
        integrator: integrator("leapfrog"),
        dt: 0.003,
        bounds: all,
        solver: motes::Solver::default(),
    };
    let simulation = Rc::new(RefCell::new(simulation(device, machine, &setup)));
    let problem = setup.problem(machine).expect("a problem");
    let plan = alone(curious(&problem));
    stages.push(Stage::amid("seen", &simulation, plan));
}

const CURIOUS: &str = "struct Sum { acceleration: vec3f, state: f32 }
fn acts_on(me: Particle) -> bool { return me.index % 5u != 1u; }
fn gather(me: Particle, you: Particle, r: vec3f, sum: ptr<function, Sum>) {
    let near = 1.0 / (1.0 + 40.0 * dot(r, r));
    (*sum).acceleration += (you.mass * near) * (you.velocity - me.velocity + f32(you.index % 7u) * r);
    (*sum).state += near * (you.density + you.pressure);
}
fn finish(me: Particle, sum: Sum) -> vec4f { return vec4f(sum.acceleration, 2.0 * sum.state); }";

fn curious(problem: &Problem) -> Kernel {
    let grid = Grid::apart(2.0 * SPACING, problem).expect("a grid");
    let candidate = Candidate {
        particle: motes::shader!("sph/flowing.wgsl"),
        broadcast: motes::shader!("sph/flowing_broadcast.wgsl"),
        listed: None,
    };
    let (files, constants) = (Vec::new(), Vec::new());
    let search = Search { grid: Some(grid.clone()), candidate, fields: vec!["flow"], files, constants, fixed: true };
    let gather = |me: &Particle, you: &Particle, r: DVec3, _: &World, sum: &mut DVec4| {
        let near = 1.0 / (1.0 + 40.0 * r.length_squared());
        let way = you.velocity - me.velocity + (you.index % 7) as f64 * r;
        let flow = you.vector("flow").unwrap_or(DVec4::NAN);
        *sum += near * (you.mass * way).extend(flow.x + flow.y);
    };
    let finish = |me: &Particle, sum: &DVec4, _: &World, outcome: &mut Outcome| {
        if me.index % 5 != 1 {
            outcome.accelerate(*sum * DVec4::new(1.0, 1.0, 1.0, 2.0));
        }
    };
    let (wgsl, into) = (Source::ours("curious", CURIOUS), [ACCELERATION.name]);
    let law = Law::searching("seen", &grid, search, wgsl, &into, gather, finish);
    law.kernel(problem).expect("a search")
}
