//! Stages of what builds a tree: so many bodies that its levels fill workgroups, and a few.

#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

use std::cell::RefCell;
use std::rc::Rc;

use glam::Vec4;
use motes::kernel::{ACCELERATION, Backend, Machine, POSITION, Problem};
use motes::tree::{Opening, Tree};

use crate::stages::{Device, Stage, moving, put};
use crate::support::equivalents::{Equivalent, same};
use crate::support::machines::alone;
use crate::support::{Random, Shared};

const MACHINE: Machine = Machine { software: true, subgroup: 0, invocations: 256, ..Machine::HOST };

const EDGE: &str = "no cube is just so wide";

pub const EQUIVALENT: &[Equivalent] = &[
    same("tree/hilbert", "bit > 1u;", ">", ">=", "there is nothing below the last bit"),
    same("tree/cube", "if side > LEAST", ">", ">=", EDGE),
    same("tree/cube", "if side > LEAST", "<", "<=", EDGE),
    same(
        "tree/node",
        "var part = 0.0;",
        "0.0",
        "1.0",
        "where nothing weighs anything, the centre is put elsewhere in the end",
    ),
];

/// Every kernel of a tree but the sorts and reductions, each amid what those before it left, its own results away.
fn build(device: &Device, opening: Opening, core: f64, bodies: &[Vec4], last: &[Vec4], stages: &mut Vec<Stage>) {
    with_free(device, opening, core, (bodies, last, 0), stages);
}

/// The same, of which so many rows at the end are free.
fn with_free(
    device: &Device,
    opening: Opening,
    core: f64,
    (bodies, last, free): (&[Vec4], &[Vec4], u32),
    stages: &mut Vec<Stage>,
) {
    let mut simulation = moving(device, bodies.len(), Some(MACHINE));
    simulation.write(POSITION, bodies).expect("bodies");
    put(&mut simulation, ACCELERATION, last);
    let count = u32::try_from(bodies.len()).expect("few");
    simulation.backend().set_rows(count - free, free).expect("rows");
    let problem = Problem::new(count, MACHINE);
    let shared = Rc::new(RefCell::new(simulation));
    for kernel in Tree::new(opening, core, &problem).kernels(&problem).expect("kernels") {
        let plan = alone(kernel.clone());
        let program = shared.borrow_mut().backend().compile(&plan).expect("a program");
        if kernel.passes.iter().any(|p| {
            p.shader
                .sources()
                .iter()
                .any(|s| s.file.starts_with("shaders/tree/") || s.file.ends_with("reduce_rows.wgsl"))
        }) {
            let mut random = Random::new(29);
            for name in kernel.writes() {
                let mut simulation = shared.borrow_mut();
                let gpu = simulation.backend();
                let words: Vec<f32> = (0..gpu.size(&name) / 4).map(|_| random.narrow()).collect();
                gpu.write_bytes(&name, 0, bytemuck::cast_slice(&words)).expect("a field");
            }
            stages.push(Stage::amid(&format!("{} of {count}", kernel.name), &shared, plan));
        }
        shared.borrow_mut().backend().run(&program, 1).expect("a run");
    }
}

/// Bodies in a box whose last side is the longest, some of them, and all of some nodes, without mass.
fn bodies(count: usize) -> Vec<Vec4> {
    let mut random = Random::new(37);
    let mass = |i: usize| if i % 3 == 1 || i % 64 < 24 { 0.0 } else { 0.3 + 0.01 * (i % 7) as f64 };
    // Along the curve neighbours are near: where the place chooses the massless ones, whole nodes are without mass.
    let mut all: Vec<Vec4> =
        (0..count).map(|i| (random.vector() * glam::DVec3::new(1.0, 1.7, 2.3)).extend(mass(i)).as_vec4()).collect();
    all.iter_mut().filter(|b| b.x > 0.4).for_each(|b| b.w = 0.0);
    all
}

pub fn all(shared: &Shared, stages: &mut Vec<Stage>) {
    // A device of four workgroups in a row, four times, has not enough of them.
    let device = &pollster::block_on(crate::support::limited(shared, |_| ()));
    let geometric = Opening::Geometric { theta: 0.7 };
    let relative = Opening::Relative { alpha: 0.005, g: 1.3, theta: 0.6 };
    let mut random = Random::new(41);
    // So many groups of 32 that they take two workgroups; the last group is full.
    let last: Vec<Vec4> = (0..2080).map(|_| random.vector().extend(random.next()).as_vec4()).collect();
    let mut quiet = last.clone();
    quiet[1000] = Vec4::ZERO;
    build(device, relative, 0.0, &bodies(2080), &quiet, stages);
    build(device, geometric, 0.3, &bodies(500), &last[..500], stages);
    // Leaves, groups and levels of which some are free.
    with_free(device, relative, 0.0, (&bodies(500), &last[..500], 131), stages);
    with_free(device, geometric, 0.3, (&bodies(203), &last[..203], 74), stages);
    // A few with next to no last acceleration, in some directions none, and one group with none at all.
    let mut last: Vec<Vec4> = last.iter().take(77).map(|a| 1e-25 * *a).collect();
    (0..77).step_by(2).for_each(|i| last[i].x = 0.0);
    (0..77).step_by(3).for_each(|i| last[i].y = 0.0);
    last[5] = Vec4::ZERO;
    build(device, relative, 0.3, &bodies(77), &last, stages);
    // Cubes that are just wide enough, and too narrow.
    for side in [3e-32, 1e-33_f32] {
        let mut simulation = moving(device, 2, Some(MACHINE));
        let gpu = simulation.backend();
        let problem = Problem::new(2, MACHINE);
        let kernels = Tree::new(geometric, 0.0, &problem).kernels(&problem).expect("kernels");
        let kernel = kernels.into_iter().find(|kernel| kernel.name.starts_with("cube")).expect("a cube");
        gpu.compile(&alone(kernel.clone())).expect("a program");
        let corners = [("tree_least", [0.0; 4]), ("tree_greatest", [0.1 * side, 0.2 * side, side, 1.0])];
        for (name, corner) in corners {
            gpu.write_bytes(name, 0, bytemuck::cast_slice(&corner)).expect("a corner");
        }
        stages.push(Stage::new(&format!("a cube of {side}"), simulation, kernel));
    }
}
