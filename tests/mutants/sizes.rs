//! Stages of a fluid whose pressure is solved for, of one particle, of two and two, and of many.
#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

use std::cell::RefCell;
use std::rc::Rc;

use glam::DVec3;
use motes::kernel::{ALARM, Backend, Kernel, Plan, QUIET};
use motes::settings::Value;
use motes::{Bounds, Gpu, POSITION, Setup, Simulation, State};

use crate::dfsph::{ANYTIME, SPACING, anything, words};
use crate::stages::{Device, Stage};
use crate::support::machines::alone;
use crate::support::states::{force, integrator, word};
use crate::support::{Random, Shared};

/// A stage for each of what few show, and many.
pub fn all(shared: &Shared, device: &Device, stages: &mut Vec<Stage>) {
    for flat in [false, true] {
        pairs(device, flat, stages);
    }
    lone(device, stages);
    over_dense(device, stages);
    // More than the smaller device takes in one dispatch.
    many(&(shared.found.device.clone(), shared.found.queue.clone()), stages);
}

/// A fluid of those, at rest, a step on its way.
fn resting(device: &Device, places: &[DVec3], flat: bool) -> (Rc<RefCell<Simulation<Gpu>>>, Plan) {
    let mut particles = State::default();
    let mass = SPACING.powi(if flat { 2 } else { 3 });
    for place in places {
        particles.push(*place, DVec3::ZERO, mass, 0.0);
    }
    let number = |key, x| (key, Value::Number(x));
    let settings = [number("spacing", SPACING), number("density", 1.0), ("solver", word("dfsph"))];
    let mut gpu = Gpu::new(&device.0, &device.1, particles.len() as u32).expect("a GPU");
    gpu.pad(5);
    let bounds = Bounds { dimensions: if flat { 2 } else { 3 }, ..Bounds::default() };
    let (forces, integrator) = (vec![force("fluid", &settings)], integrator("symplectic_euler"));
    let setup = Setup { state: particles, forces, integrator, dt: 0.007, bounds, solver: motes::Solver::default() };
    let plan = setup.plans(gpu.machine()).expect("plans").step;
    let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
    simulation.step(1).expect("a step");
    (Rc::new(RefCell::new(simulation)), plan)
}

fn named(plan: &Plan, name: &str) -> Kernel {
    plan.steps().find(|kernel| kernel.name == name).expect("a kernel").clone()
}

/// Pairs further and further into each other's range: 1 / α is about 15 (1 − r / h)⁴ / h² in the plane and 7 in space, so that of
/// each some pairs are on both sides of what counts as nothing, one of them near to it.
///
/// α is four times as wrong as 1 − r / h, of which two roundings of r / h are 2 · 6e-8 / 0.0145 = 8e-6: three times the usual.
fn pairs(device: &Device, flat: bool, stages: &mut Vec<Stage>) {
    let pair = |k: i32| {
        let apart = 2.0 * SPACING * (1.0 - 0.0145 * 1.09f64.powi(k));
        [0.0, apart].map(|x| DVec3::new(x, 0.5 * f64::from(k), 0.0).as_vec3().as_dvec3())
    };
    let places: Vec<DVec3> = (0..6).flat_map(pair).collect();
    let (simulation, plan) = resting(device, &places, flat);
    let response = alone(named(&plan, "fluid response"));
    // It is made anew, and judged by how it changes.
    let field = response.fields(1).into_keys().find(|name| name.starts_with("responses")).expect("a field");
    words(&simulation, &field, &[0.0; 48]);
    let name = format!("fluid response of pairs, flat {flat}");
    stages.push(Stage::amid(&name, &simulation, response).slack(4.0));
}

/// A state that no particle but the first starts over.
fn lone(device: &Device, stages: &mut Vec<Stage>) {
    let (simulation, plan) = resting(device, &[DVec3::ZERO], false);
    for name in ["fluid begin", "fluid collect"] {
        stages.push(anything(&simulation, (&named(&plan, name), 1), &format!("{name}, alone"), ANYTIME));
    }
}

/// As many within reach of each other as there is room for, and more: the first of those is reported.
fn over_dense(device: &Device, stages: &mut Vec<Stage>) {
    /// Neighbours in space, of a support of two spacings.
    const ROOM: usize = 72;
    for more in [1, 3] {
        let mut random = Random::new(31);
        let one = |_| (random.vector() * 0.4 * SPACING).as_vec3().as_dvec3();
        let places: Vec<DVec3> = (0..ROOM + more).map(one).collect();
        let (simulation, plan) = resting(device, &places, false);
        words(&simulation, ALARM.name, &QUIET.map(f32::from_bits));
        // Where they were before they burst.
        let back: Vec<f32> =
            places.iter().flat_map(|x| x.as_vec3().extend(SPACING.powi(3) as f32).to_array()).collect();
        words(&simulation, POSITION.name, &back);
        let grid = plan.steps().find(|kernel| kernel.name.starts_with("grid")).expect("a grid").clone();
        let both = Plan::of([grid, named(&plan, "fluid response")]);
        let stage = Stage::amid(&format!("{more} more than there is room for"), &simulation, both).slack(4.0);
        let first = [u32::MAX, u32::MAX, 0, u32::MAX, u32::MAX, 0, 0, 0];
        let expected = || first.map(f32::from_bits).to_vec();
        stages.push(if more == 1 { stage } else { stage.expected(ALARM.name, expected()) });
    }
}

/// Errors of so many that they are added in two dispatches.
fn many(device: &Device, stages: &mut Vec<Stage>) {
    // Whole runs, so that a workgroup too many begins right where the errors end.
    const MANY: usize = 5 * 2048;
    let mut particles = State::default();
    let mut random = Random::new(19);
    for n in 0..MANY {
        particles.push(DVec3::X * n as f64, DVec3::ZERO, 1.0, 0.0);
    }
    let forces = vec![force("fluid", &[("spacing", Value::Number(0.1)), ("solver", word("dfsph"))])];
    let mut gpu = Gpu::new(&device.0, &device.1, MANY as u32).expect("a GPU");
    gpu.pad(5);
    let integrator = integrator("symplectic_euler");
    let setup = Setup {
        state: particles,
        forces,
        integrator,
        dt: 0.007,
        bounds: Bounds::default(),
        solver: motes::Solver::default(),
    };
    let plan = setup.plans(gpu.machine()).expect("plans").step;
    let simulation = Rc::new(RefCell::new(Simulation::on(gpu, &setup).expect("a simulation")));
    let errors: Vec<f32> = (0..MANY).map(|_| 1.3 + random.narrow()).collect();
    for which in ["divergence", "density"] {
        let [tally, decide] = ["tally", "decide"].map(|end| named(&plan, &format!("fluid {which} {end}")));
        words(&simulation, tally.passes[0].field("errors"), &errors);
        words(&simulation, decide.passes[0].field("errors"), &errors[..MANY.div_ceil(2048)]);
        let mut wider = tally.clone();
        wider.name.push_str(", wider");
        wider.passes[0].threads.count += 256;
        for kernel in [tally, wider, decide] {
            stages.push(Stage::amid(&format!("{} of many", kernel.name), &simulation, alone(kernel)));
        }
    }
}
