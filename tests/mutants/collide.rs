//! Stages of collisions: every kernel in a crowd in which many touch.

#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds, and few")]

use std::cell::RefCell;
use std::rc::Rc;

use glam::{DVec3, Vec4};
use motes::integrators::{Adaptive, Precise};
use motes::kernel::{
    ACCELERATION, AdaptiveStep, Array, Backend, Column, Kernel, Kind, LIFE, Machine, POSITION_LOW, Plan, Precision,
    STEP_CLOCK, VELOCITY_LOW, World,
};
use motes::motion::{Held, Hold};
use motes::settings::Value;
use motes::{Bounds, Gpu, Setup, Side, Simulation, State};

use crate::stages::{Device, FEW, Stage, put};
use crate::support::Random;
use crate::support::equivalents::{Equivalent, same};
use crate::support::machines::alone;
use crate::support::states::{force, integrator, word};

const BEHIND: &str = "what is behind the last row is no partner";
const EACH: &str = "no row is its own partner, and either of two may do it for both";

pub const EQUIVALENT: &[Equivalent] = &[
    same("collide/bounce", "if i >= world.count", ">=", ">", BEHIND),
    same("collide/merge", "if row >= world.count", ">=", ">", BEHIND),
    same("collide/merge", "if other == NONE", "<", "<=", EACH),
    same("collide/record", "if i >= world.count", ">=", ">", BEHIND),
    same("collide/bounce", "if j == NONE", "<", "<=", EACH),
    same("collide/bounce", "if j == NONE", "<", ">", EACH),
    same("collide/pair", "if partner > 0u", ">", ">=", BEHIND),
    same("collide/among_all", "let reach =", "2.001", "3.0015", "more are looked at than need be"),
    same("collide/among_all", "let reach =", "*", "/", "tests/physics/collisions/mergers.rs has far ones that touch"),
    same("collide/among_all", "if dot(r, r)", "<=", "<", "what is just so far touches only by rounding"),
    same("updaters/collide", "if reach > 0.0", ">", ">=", "no square is below 0"),
    same(
        "collide/volume",
        "if large <= 0.0",
        "<=",
        "<",
        "tests/physics/collisions has bodies without a size in pictures",
    ),
    same("updaters/collide", "if MERGES && approach", ">", ">=", "then the closest approach is now"),
    same("updaters/collide", "let before =", "<", "<=", "no partner is met twice"),
];

/// Many that touch, at all distances; some are fixed, without mass, as heavy or as near as others, at rest.
fn crowd(seed: u64, fixed: bool, apart: bool) -> State {
    let mut random = Random::new(seed);
    let mut state = State::default();
    for k in 0..FEW {
        let mass = [0.0, 1.0, 1.0, 2.5 + random.next(), 0.3][k % 5];
        let single = |v: DVec3| v.as_vec3().as_dvec3();
        let velocity = if k % 9 == 4 { DVec3::ZERO } else { single(random.vector()) };
        state.push(single(random.vector()), velocity, f64::from(mass as f32), 0.03 * f64::from((k % 3) as u32));
    }
    // Some stand in rows of equal distances, unless no two distances may be equal.
    for k in (0..if apart { 0 } else { 60 }).step_by(3) {
        for n in 0..3 {
            state.position_mut()[k + n] = DVec3::new(0.03125 * n as f64 - 0.75, 0.0625 * k as f64 - 2.0, 3.0);
            state.velocity_mut()[k + n] = DVec3::new(-0.25 * n as f64, 0.0, 0.0);
        }
    }
    let column = Column::new("collision_radius", Kind::Scalar, "length", "of the sphere that collides").required();
    state.declare(&column).expect("a column");
    let radii =
        (0..FEW).map(|k| if k % 11 == 7 { 0.0 } else { f64::from(0.05 * (1.5 + random.next()) as f32) }).collect();
    let mut radii: Vec<f64> = radii;
    // The first that merges has then just the largest radius; two more just do not touch.
    for (row, x, radius) in [(0, 0.0, 0.125), (1, 0.0625, 0.0), (60, 1.0, 0.125), (61, 1.25, 0.125)] {
        state.position_mut()[row] = DVec3::new(x, 0.0, 5.0);
        state.velocity_mut()[row] = DVec3::ZERO;
        state.mass_mut()[row] = 1.0;
        radii[row] = radius;
    }
    state.set("collision_radius", Array::Float(radii)).expect("radii");
    if fixed {
        state.held = (0..FEW as u32).step_by(4).map(|id| Held { id, by: Hold::Fixed }).collect();
        (0..FEW).step_by(4).for_each(|id| state.velocity_mut()[id] = DVec3::ZERO);
    }
    state
}

/// The kernels of collisions at the end of a step, each amid what those before it left.
fn step(device: &Device, name: &str, machine: Machine, setup: &Setup, stages: &mut Vec<Stage>) {
    let mut gpu = Gpu::new(&device.0, &device.1, u32::try_from(FEW).expect("few")).expect("a GPU");
    gpu.pad(5);
    gpu.pretend(machine);
    let mut simulation = Simulation::on(gpu, setup).expect("a simulation");
    let mut plan = Plan::default();
    let problem = setup.problem(machine).expect("a problem");
    setup.forces[0].stage(motes::forces::Stage::EndOfStep, &mut plan, &problem).expect("kernels");
    let double = setup.integrator.precision().is_double();
    simulation.backend().compile(&plan).expect("a good plan");
    if setup.has_inactive() {
        put(&mut simulation, LIFE, &(0..FEW).map(|k| [1, 1, 1, 0, 1, 2][(k / 10) % 6]).collect::<Vec<u32>>());
    }
    let mut random = Random::new(5);
    let words: Vec<Vec4> = (0..FEW).map(|_| random.vector().as_vec3().extend(random.narrow())).collect();
    put(&mut simulation, ACCELERATION, &words);
    if double {
        for field in [POSITION_LOW, VELOCITY_LOW] {
            let words: Vec<Vec4> = (0..FEW).map(|_| (1e-3 * random.vector()).as_vec3().extend(0.0)).collect();
            put(&mut simulation, field, &words);
        }
    }
    if setup.integrator.adaptive_step().is_some() {
        put(&mut simulation, STEP_CLOCK, &[7, 3 << 20, 5 << 21]);
    }
    let clock = pollster::block_on(simulation.backend().world()).expect("a clock");
    let amid = Rc::new(RefCell::new(simulation));
    let mut before = None;
    let last = |dt: f64| amid.borrow_mut().backend().set_world(World { step: 11, dt, ..clock }).expect("a clock");
    last(0.875);
    for kernel in &plan.kernels {
        let program = amid.borrow_mut().backend().compile(&alone(kernel.clone())).expect("a program");
        if kernel.name == "collide" {
            // In a step of no length nothing happens.
            last(0.0);
            stages.push(Stage::amid(&format!("no step, {name}"), &amid, alone(kernel.clone())));
            last(0.875);
        }
        if kernel.name.starts_with("collide") {
            // Parts of masses are single numbers, and so is the line of centres: what they make of a low word is as rounded as forces are.
            let slack = if double { 8.0 } else { 1.0 };
            // Which bodies are gone a search knows by the cell list alone.
            let cells = before.take().filter(|_: &Kernel| kernel.name == "collide");
            let own = Plan::of(cells.into_iter().chain([kernel.clone()]));
            stages.push(Stage::amid(&format!("{}, {name}", kernel.name), &amid, own).slack(slack));
        }
        amid.borrow_mut().backend().run(&program, 1).expect("a run");
        before = Some(kernel.clone());
    }
}

pub fn all(device: &Device, stages: &mut Vec<Stage>) {
    let periodic = Bounds::new(DVec3::splat(-1.1), DVec3::splat(1.1), Side::Periodic);
    let merge: &[(&'static str, Value)] = &[];
    let bounce: &[(&'static str, Value)] = &[("outcome", word("bounce")), ("restitution", Value::Number(0.7))];
    let near: &[(&'static str, Value)] = &[("over", word("near")), ("range", Value::Number(0.25))];
    let double = Precision::DoubleSingle;
    let cases = [
        ("merge", merge, Precision::Single, false, Bounds::default(), false),
        ("merge, fixed", merge, Precision::Single, true, periodic, true),
        ("merge, two words", merge, double, true, Bounds::default(), false),
        ("merge near", merge, Precision::Single, false, Bounds::default(), false),
        ("bounce", bounce, Precision::Single, false, periodic, false),
        ("bounce, fixed", bounce, Precision::Single, true, Bounds::default(), false),
        ("bounce, two words", bounce, double, true, Bounds::default(), false),
    ];
    for (place, (name, outcome, precision, fixed, bounds, adaptive)) in cases.into_iter().enumerate() {
        let settings = if precision == double || place % 2 == 0 && place != 3 {
            outcome.to_vec()
        } else {
            [outcome, near].concat()
        };
        let mut state = crowd(71 + place as u64, fixed, place == 3);
        if bounds.has(Side::Periodic) {
            state.position_mut().iter_mut().for_each(|x| *x = x.clamp(DVec3::splat(-1.05), DVec3::splat(1.05)));
        }
        let mut method = integrator(if adaptive { "gauss_radau" } else { "leapfrog" });
        if adaptive {
            let adaptive_step = AdaptiveStep { least: 1e-4, courant: 0.25, before: None };
            method = Box::new(Adaptive { integrator: method, adaptive_step });
        }
        let integrator = Box::new(Precise { integrator: method, precision });
        let forces = vec![force("collide", &settings)];
        let setup = Setup { bounds, integrator, ..Setup::new(state, forces, 0.03) };
        step(device, name, Machine::HOST, &setup, stages);
    }
}
