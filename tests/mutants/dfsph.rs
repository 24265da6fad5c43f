//! Stages of a fluid whose pressure is solved for: before every kernel of a step as it stands then, and where solves end.
#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use glam::{DVec3, Vec4};
use motes::kernel::{Backend, Kernel, Machine, Plan, World};
use motes::motion::{Held, Hold};
use motes::settings::Value;
use motes::sph::DFSPH_REPORT;
use motes::{Bounds, Gpu, Setup, Side, Simulation, State, VELOCITY};

use crate::stages::{Device, Stage, next};
use crate::support::machines::alone;
use crate::support::states::{force, integrator, word};
use crate::support::{Random, Shared};

pub const SPACING: f64 = 0.06;
/// What a stage keeps of a name: the second time that a kernel runs, an iteration has something to continue from.
const SECOND: u32 = 2;
/// These are shown numbers of all kinds as well, also such as no step comes by.
const ANY: [&str; 5] = ["begin", "collect", "predict", "divergence correct", "finish"];

/// A step so long that what a residual changes κ by is about 1, less or more.
pub const ANYTIME: f64 = 0.13;

/// A jittered block on a floor, of masses that are not all the same, and a few particles that are alone or nearly so; eight
/// workgroups of slots, which is two rows of the smaller device, and none too many.
fn block(flat: bool) -> (State, Bounds) {
    let (wide, layers) = if flat { (20, 23) } else { (6, 12) };
    let mut random = Random::new(17);
    let mut particles = State::default();
    let area = SPACING * SPACING;
    let mass = 700.0 * if flat { area } else { area * SPACING };
    for k in 0..=layers {
        for n in 0..if flat { wide } else { wide * wide } {
            let jitter = random.vector() * if k == 0 { 0.0 } else { 0.2 };
            let place = DVec3::new(f64::from(n % wide), f64::from(n / wide), f64::from(k)) + jitter + DVec3::splat(0.5);
            let place = if flat { DVec3::new(place.x, place.z, 0.0) } else { place };
            if k == 0 {
                particles.held.push(Held { id: particles.len() as u32, by: Hold::Fixed });
            }
            let heavy = f64::from((mass * (1.0 + 0.1 * random.next())) as f32);
            particles.push((SPACING * place).as_vec3().as_dvec3(), DVec3::ZERO, heavy, 0.0);
        }
    }
    let bounds = Bounds {
        low: DVec3::ZERO,
        high: DVec3::splat(SPACING * f64::from(wide)),
        sides: [Side::Periodic, Side::Open, Side::Open],
        dimensions: if flat { 2 } else { 3 },
    };
    // A particle without neighbours, and a pair of which each is at the edge of the other's range.
    let off = if flat { DVec3::Y } else { DVec3::Z };
    for height in [2.0, 3.0, 3.0 + 1.995 * SPACING] {
        particles.push((height * off + 0.4 * DVec3::X).as_vec3().as_dvec3(), DVec3::ZERO, mass, 0.0);
    }
    (particles, bounds)
}

/// `walks`: as on a device that has no room for pairs.
fn simulation(device: &Device, flat: bool, walks: bool) -> (Simulation<Gpu>, Plan, usize) {
    let (particles, bounds) = block(flat);
    let number = |key, x| (key, Value::Number(x));
    let settings = [
        number("spacing", SPACING),
        number("density", 700.0),
        number("max_iterations", 7.0),
        number("min_iterations", 3.0),
        number("tolerance", 2e-5),
        number("divergence_tolerance", 3e-5),
        ("solver", word("dfsph")),
    ];
    let forces = vec![force("fluid", &settings), force("uniform", &[])];
    let mut gpu = Gpu::new(&device.0, &device.1, particles.len() as u32).expect("a GPU");
    gpu.pad(5);
    if walks {
        let machine = gpu.machine();
        gpu.pretend(Machine { bindable: 0, ..machine });
    }
    let setup = Setup {
        state: particles,
        forces,
        integrator: integrator("symplectic_euler"),
        dt: 0.007,
        bounds,
        solver: motes::Solver::default(),
    };
    let fluid = setup.state.len() - setup.state.held.len();
    let plan = setup.plans(gpu.machine()).expect("plans").step;
    let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
    simulation.step(2).expect("two steps");
    let mut random = Random::new(5);
    let count = setup.state.len();
    let velocity = (0..count).map(|_| {
        let v = random.vector() * 1.5;
        (if flat { v.with_z(0.0) } else { v }).as_vec3().extend(0.0)
    });
    simulation.write(VELOCITY, &velocity.collect::<Vec<Vec4>>()).expect("velocities");
    (simulation, plan, fluid)
}

/// A stage of each kernel of a step, and of how solves continue and end.
pub fn all(shared: &Shared, device: &Device, stages: &mut Vec<Stage>) {
    for (flat, walks) in [(false, false), (true, false), (false, true)] {
        let (simulation, plan, fluid) = simulation(device, flat, walks);
        let simulation = Rc::new(RefCell::new(simulation));
        let mut met = BTreeMap::<String, u32>::new();
        let mut walk = plan.walk();
        while let Some(kernel) = next(&mut walk, &simulation) {
            let times = met.entry(kernel.name.clone()).or_default();
            *times += 1;
            let iterates = kernel.name.contains("push") || kernel.name.contains("correct");
            let searches = iterates || kernel.name.contains("response") || kernel.name.contains("predict");
            let shown = kernel.name.starts_with("fluid") && (searches || !walks);
            if shown && (*times == SECOND || !iterates && *times == 1) {
                stages.push(
                    Stage::amid(
                        &format!("{}, flat {flat}, walks {walks}", kernel.name),
                        &simulation,
                        alone(kernel.clone()),
                    )
                    .slack(4.0),
                );
                if !walks && ANY.iter().any(|end| kernel.name.ends_with(end)) {
                    let name = format!("{} of any, flat {flat}", kernel.name);
                    stages.push(anything(&simulation, (kernel, fluid), &name, ANYTIME));
                }
            }
            let named = |name: &str| plan.steps().find(|kernel| kernel.name == name).expect("a kernel").clone();
            if kernel.name.starts_with("grid") && !walks {
                stages.push(Stage::amid(&format!("{}, flat {flat}", kernel.name), &simulation, alone(kernel.clone())));
            }
            if kernel.name == "fluid response" && !walks {
                // The kernel that visits the pairs defines what the pairs are.
                let both = Plan::of([kernel.clone(), named("fluid predict")]);
                stages.push(Stage::amid(&format!("pairs, flat {flat}"), &simulation, both).slack(4.0));
            }
            let mut simulation = simulation.borrow_mut();
            let gpu = simulation.backend();
            let program = gpu.compile(&alone(kernel.clone())).expect("a kernel");
            gpu.run(&program, 1).expect("a run");
        }
        if !flat && !walks {
            let named = |end: &str| plan.steps().find(|kernel| kernel.name.ends_with(end)).expect("a kernel").clone();
            for which in ["divergence", "density"] {
                ends(&simulation, &named(&format!("{which} decide")), stages);
            }
            for (codes, failed) in
                [([1.0, 3.0], [0, 0]), ([3.0, 1.0], [0, 0]), ([2.0, 2.0], [3, 0]), ([2.0, 3.0], [0, 3])]
            {
                state(&simulation, codes);
                let report = failed.map(|failed| [7, failed, 99, if failed > 0 { 9 } else { 1 }, 50, 60]);
                words(&simulation, DFSPH_REPORT, &report.concat().into_iter().map(f32::from_bits).collect::<Vec<_>>());
                stages.push(Stage::amid(&format!("keep {codes:?}"), &simulation, alone(named("keep"))));
            }
        }
    }
    crate::sizes::all(shared, device, stages);
}

/// A kernel where what solves know of so many of the fluid is any number, in steps of such a length; what was there is put back.
pub fn anything(
    simulation: &Rc<RefCell<Simulation<Gpu>>>,
    (kernel, fluid): (&Kernel, usize),
    name: &str,
    dt: f64,
) -> Stage {
    let plan = alone(kernel.clone());
    let mut random = Random::new(29);
    let mut before = Vec::new();
    let clock = pollster::block_on(simulation.borrow_mut().backend().world()).expect("a clock");
    for field in plan.fields(1).into_keys() {
        let mut simulation = simulation.borrow_mut();
        let gpu = simulation.backend();
        let elements = gpu.size(&field) as usize / 4;
        let mut any = |element: usize| {
            let x = random.narrow();
            let wall = element / 4 >= fluid;
            match (field.split(' ').next().unwrap_or_default(), element % 4) {
                ("unknowns", 0) if wall => Some(-1.0),
                ("pushes", 3) if wall => Some(0.0),
                ("unknowns", 2) if element.is_multiple_of(3) => Some(0.0),
                ("unknowns", 2) | ("stiffness" | "warm_start", _) => Some(x.abs()),
                ("pushes", 3) => Some(if x > -0.5 { 1.0 } else { 0.0 }),
                ("unknowns" | "pushes" | "errors", _) => Some(x),
                ("dfsph_state", _) => Some([4.0, if name.contains("correct") { 0.0 } else { 3.0 }, 0.3][element % 3]),
                _ => None,
            }
        };
        let words: Option<Vec<f32>> = (0..elements).map(&mut any).collect();
        if let Some(words) = words {
            before.push((field.clone(), pollster::block_on(gpu.bytes(&field, 0, gpu.size(&field))).expect("a field")));
            gpu.write_bytes(&field, 0, bytemuck::cast_slice(&words)).expect("a field");
        }
    }
    simulation.borrow_mut().backend().set_world(World { dt, ..clock }).expect("a clock");
    let stage = Stage::amid(name, simulation, plan).slack(4.0);
    let mut simulation = simulation.borrow_mut();
    let gpu = simulation.backend();
    for (field, bytes) in before {
        gpu.write_bytes(&field, 0, &bytes).expect("a field");
    }
    gpu.set_world(clock).expect("a clock");
    stage
}

pub fn words(simulation: &Rc<RefCell<Simulation<Gpu>>>, field: &str, words: &[f32]) {
    let mut simulation = simulation.borrow_mut();
    simulation.backend().write_bytes(field, 0, bytemuck::cast_slice(words)).expect("a field");
}

/// Iterations, codes and errors of the two solves.
fn state(simulation: &Rc<RefCell<Simulation<Gpu>>>, [first, second]: [f32; 2]) {
    words(simulation, "dfsph_state", &[4.0, first, 0.3, 5.0, second, 0.7]);
}

/// How a solve continues, converges, is not done yet, runs out, and breaks down.
fn ends(simulation: &Rc<RefCell<Simulation<Gpu>>>, decide: &Kernel, stages: &mut Vec<Stage>) {
    let field = decide.passes[0].field("errors").to_owned();
    let count = simulation.borrow().count() as usize;
    let mut random = Random::new(7);
    for (mean, iterations, code) in
        [(1e-3, 3.0, 0.0), (1e-5, 2.0, 0.0), (1e-5, 1.0, 0.0), (1e-3, 6.0, 0.0), (1e-3, 5.0, 0.0)]
    {
        let errors: Vec<f32> = (0..count).map(|_| mean * (1.0 + 0.5 * random.narrow())).collect();
        words(simulation, &field, &errors);
        words(simulation, "dfsph_state", &[iterations, code, 0.3, iterations, code, 0.7]);
        stages.push(Stage::amid(
            &format!("{} {mean} {iterations} {code}", decide.name),
            simulation,
            alone(decide.clone()),
        ));
    }
    words(simulation, &field, &[f32::INFINITY]);
    words(simulation, "dfsph_state", &[3.0, 0.0, 0.3, 3.0, 0.0, 0.7]);
    // Both are expected values, since infinity cannot be compared.
    let expected = if decide.name.contains("divergence") {
        vec![4.0, 2.0, f32::INFINITY, 3.0, 0.0, 0.7]
    } else {
        vec![3.0, 0.0, 0.3, 4.0, 2.0, f32::INFINITY]
    };
    stages.push(
        Stage::amid(&format!("{}, broken", decide.name), simulation, alone(decide.clone()))
            .expected("dfsph_state", expected),
    );
    words(simulation, &field, &[1e-3]);
}
