//! Stages of a fluid whose pressure is solved for: before every kernel of a step as it stands then, and where solves end.
#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::rc::Rc;

use glam::{DVec3, Vec4};
use motes::kernel::{Backend, Kernel, Plan};
use motes::motion::{Held, Hold};
use motes::settings::Value;
use motes::{Bounds, Gpu, Particles, Setup, Side, Simulation, VELOCITY};

use crate::stages::{Device, Stage};
use crate::support::machines::alone;
use crate::support::states::{force, integrator, word};
use crate::support::{Random, Shared};

const SPACING: f64 = 0.06;
/// What a stage keeps of a name: the second time that a kernel runs, an iteration has something to go on from.
const SECOND: u32 = 2;

/// A jittered block on a floor, of masses that are not all the same, and a few particles that are alone or nearly so; more than
/// four workgroups of slots.
fn block(flat: bool) -> (Particles, Bounds) {
    let (wide, layers) = if flat { (20, 13) } else { (6, 7) };
    let mut random = Random::new(17);
    let mut particles = Particles::default();
    let area = SPACING * SPACING;
    let mass = 700.0 * if flat { area } else { area * SPACING };
    for k in 0..=layers {
        for n in 0..if flat { wide } else { wide * wide } {
            let jitter = random.vector() * if k == 0 { 0.0 } else { 0.2 };
            let place = DVec3::new((n % wide) as f64, (n / wide) as f64, k as f64) + jitter + DVec3::splat(0.5);
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
    // One that nobody is near, and a pair of which each is at the rim of the other's range.
    let off = if flat { DVec3::Y } else { DVec3::Z };
    for height in [2.0, 3.0, 3.0 + 1.995 * SPACING] {
        particles.push((height * off + 0.4 * DVec3::X).as_vec3().as_dvec3(), DVec3::ZERO, mass, 0.0);
    }
    (particles, bounds)
}

fn simulation(device: &Device, flat: bool) -> (Simulation<Gpu>, Plan) {
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
    let setup = Setup {
        particles,
        forces,
        integrator: integrator("symplectic_euler"),
        dt: 0.007,
        bounds,
        solver: motes::Solver::default(),
    };
    let plan = setup.plans(gpu.machine()).expect("plans").step;
    let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
    simulation.step(2).expect("two steps");
    let mut random = Random::new(5);
    let count = setup.particles.len();
    let velocity = (0..count).map(|_| {
        let v = random.vector() * 1.5;
        (if flat { v.with_z(0.0) } else { v }).as_vec3().extend(0.0)
    });
    simulation.write(VELOCITY, &velocity.collect::<Vec<Vec4>>()).expect("velocities");
    (simulation, plan)
}

/// A stage of each kernel of a step, and of how solves go on and end.
pub fn all(shared: &Shared, device: &Device, stages: &mut Vec<Stage>) {
    for flat in [false, true] {
        let (simulation, plan) = simulation(device, flat);
        let simulation = Rc::new(RefCell::new(simulation));
        let mut met = BTreeMap::<String, u32>::new();
        for kernel in plan.steps() {
            let times = met.entry(kernel.name.clone()).or_default();
            *times += 1;
            let iterates = kernel.name.contains("push") || kernel.name.contains("correct");
            if kernel.name.starts_with("fluid") && (*times == SECOND || !iterates && *times == 1) {
                stages.push(
                    Stage::amid(&format!("{}, flat {flat}", kernel.name), &simulation, alone(kernel.clone()))
                        .slack(4.0),
                );
            }
            let mut simulation = simulation.borrow_mut();
            let gpu = simulation.backend();
            let program = gpu.compile(&alone(kernel.clone())).expect("a kernel");
            gpu.run(&program, 1).expect("a run");
        }
        if !flat {
            let named = |end: &str| plan.steps().find(|kernel| kernel.name.ends_with(end)).expect("a kernel").clone();
            for which in ["divergence", "density"] {
                ends(&simulation, &named(&format!("{which} decide")), stages);
                // Nothing moves where a solve is done.
                state(&simulation, [1.0, 2.0]);
                for end in ["push", "correct"] {
                    let name = format!("{which} {end}");
                    stages.push(Stage::amid(&format!("{name}, done"), &simulation, alone(named(&name))));
                }
            }
            for codes in [[1.0, 3.0], [3.0, 1.0], [2.0, 2.0]] {
                state(&simulation, codes);
                stages.push(Stage::amid(&format!("keep {codes:?}"), &simulation, alone(named("keep"))));
            }
        }
    }
    // More than the smaller device takes in one dispatch.
    many(&(shared.found.device.clone(), shared.found.queue.clone()), stages);
}

fn words(simulation: &Rc<RefCell<Simulation<Gpu>>>, field: &str, words: &[f32]) {
    let mut simulation = simulation.borrow_mut();
    simulation.backend().write_bytes(field, 0, bytemuck::cast_slice(words)).expect("a field");
}

/// Iterations, codes and errors of the two solves.
fn state(simulation: &Rc<RefCell<Simulation<Gpu>>>, [first, second]: [f32; 2]) {
    words(simulation, "dfsph_state", &[4.0, first, 0.3, 5.0, second, 0.7]);
}

/// How a solve goes on, converges, is not done yet, runs out, breaks down, and stays done.
fn ends(simulation: &Rc<RefCell<Simulation<Gpu>>>, decide: &Kernel, stages: &mut Vec<Stage>) {
    let field = decide.passes[0].field("errors").to_owned();
    let count = simulation.borrow().count() as usize;
    let mut random = Random::new(7);
    for (mean, iterations, code) in [
        (1e-3, 3.0, 0.0),
        (1e-5, 2.0, 0.0),
        (1e-5, 1.0, 0.0),
        (1e-3, 6.0, 0.0),
        (1e-3, 5.0, 0.0),
        (1e-3, 3.0, 1.0),
        (1e-5, 4.0, 3.0),
    ] {
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
    // Both are told, since infinity cannot be compared.
    let told = if decide.name.contains("divergence") {
        vec![4.0, 2.0, f32::INFINITY, 3.0, 0.0, 0.7]
    } else {
        vec![3.0, 0.0, 0.3, 4.0, 2.0, f32::INFINITY]
    };
    stages.push(
        Stage::amid(&format!("{}, broken", decide.name), simulation, alone(decide.clone())).told("dfsph_state", told),
    );
    words(simulation, &field, &[1e-3]);
}

/// Errors of so many that they are added in two dispatches.
fn many(device: &Device, stages: &mut Vec<Stage>) {
    const MANY: usize = 9000;
    let mut particles = Particles::default();
    let mut random = Random::new(19);
    for n in 0..MANY {
        particles.push(DVec3::X * n as f64, DVec3::ZERO, 1.0, 0.0);
    }
    let forces = vec![force("fluid", &[("spacing", Value::Number(0.1)), ("solver", word("dfsph"))])];
    let mut gpu = Gpu::new(&device.0, &device.1, MANY as u32).expect("a GPU");
    gpu.pad(5);
    let integrator = integrator("symplectic_euler");
    let setup =
        Setup { particles, forces, integrator, dt: 0.007, bounds: Bounds::default(), solver: motes::Solver::default() };
    let plan = setup.plans(gpu.machine()).expect("plans").step;
    let simulation = Rc::new(RefCell::new(Simulation::on(gpu, &setup).expect("a simulation")));
    let errors: Vec<f32> = (0..MANY).map(|_| 1.3 + random.narrow()).collect();
    for which in ["divergence", "density"] {
        let named = |end: &str| {
            let name = format!("fluid {which} {end}");
            plan.steps().find(|kernel| kernel.name == name).expect("a kernel").clone()
        };
        let (tally, decide) = (named("tally"), named("decide"));
        for (code, other) in [(0.0, 1.0), (1.0, 0.0)] {
            words(&simulation, tally.passes[0].field("errors"), &errors);
            words(&simulation, decide.passes[0].field("errors"), &errors[..MANY.div_ceil(2048)]);
            let codes = if which == "density" { [other, code] } else { [code, other] };
            state(&simulation, codes);
            for kernel in [&tally, &decide] {
                stages.push(Stage::amid(
                    &format!("{} of many, {code}", kernel.name),
                    &simulation,
                    alone(kernel.clone()),
                ));
            }
        }
    }
}
