//! Stages of columns that integrators advance, and of rigid bodies.

#![allow(clippy::cast_possible_truncation, reason = "few particles")]

use std::cell::RefCell;
use std::rc::Rc;

use motes::forces::Component;
use motes::kernel::{ALARM, Array, Backend, Column, Columns, Kernel, QUIET};
use motes::life::Life;
use motes::motion::{Held, Hold};
use motes::{Gpu, Setup, Simulation};

use crate::stages::{Device, FEW, Stage, put};
use crate::support::columns::{Bodies, Columned, Grouped, fill, give, numbers};
use crate::support::equivalents::{Equivalent, same};
use crate::support::machines::alone;
use crate::support::{self, Random};

const ALWAYS_SET: &str = "the host sets every override";

pub const EQUIVALENT: &[Equivalent] = &[
    same("integrators/pairs", "override ELEMENTS: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("integrators/pairs", "override SLOTS: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("pairs/vector.wgsl", "override FIRST: u32 = 0u;", "0u", "1u", ALWAYS_SET),
    same("pairs/vector.wgsl", "override END: u32 = 3u;", "3u", "4u", ALWAYS_SET),
    same("pairs/watch.wgsl", "override AHEAD", "0u", "1u", "every plan sets it"),
    same("pairs/watch.wgsl", "if i < ELEMENTS", "<", "<=", "what stands behind the last is a number"),
    same(
        "rotation/",
        "if i < world.count && !is_held(i) && is_active(i)",
        "<",
        "<=",
        "behind the last word of life stands none that says 1",
    ),
    same("rotation/drift.wgsl", "var body = ", "1.0", "1.5", "its length is taken away in the end"),
    same("rotation/drift.wgsl", "facing / sqrt", "/", "*", "a product of units is one but for rounding"),
    same("rotation/drift.wgsl", "facing / sqrt", "sqrt", "inverseSqrt", "a product of units is one but for rounding"),
    same(
        "rotation/body.wgsl",
        "moments > vec3f()",
        ">",
        ">=",
        "both are infinite, and no particle here is without a moment",
    ),
];

/// Every seventh is fixed, and as many do not live.
fn setup(integrator: &str) -> Setup {
    let mut setup = living(integrator);
    let life: Vec<Life> = (0..FEW).map(|id| if id % 7 == 5 { Life::Removed } else { Life::Active }).collect();
    setup.state.set_lives(&life).expect("one for each");
    setup
}

/// The same particles, all of which live.
fn living(integrator: &str) -> Setup {
    let mut particles = support::cloud(FEW, 11);
    particles.links = motes::links::Links::default();
    let fixed = (0..FEW as u32).filter(|id| id % 7 == 3);
    particles.held = fixed.map(|id| Held { id, by: Hold::Fixed }).collect();
    let forces: Vec<Box<dyn Component>> =
        vec![Box::new(Columned), Box::new(Bodies { field: false }), Box::new(Grouped)];
    let columns: Vec<Column> = forces.iter().flat_map(|force| force.columns()).collect();
    give(&mut particles, &columns, 17);
    Setup {
        state: particles,
        forces,
        integrator: support::states::integrator(integrator),
        dt: 0.37,
        bounds: motes::Bounds::default(),
        solver: motes::Solver::default(),
    }
}

fn columns() -> Vec<Column> {
    setup("leapfrog").forces.iter().flat_map(|force| force.columns()).collect()
}

/// Whether a kernel is one of columns: the laws of this file are no shaders of the crate.
fn of_columns(kernel: &Kernel) -> bool {
    let of = |folder: &str| kernel.passes[0].shader.sources().iter().any(|source| source.file.contains(folder));
    of("integrators/pairs/") || of("shaders/rotation/")
}

pub fn all(device: &Device, stages: &mut Vec<Stage>) {
    for name in ["forest_ruth", "rk4"] {
        let setup = setup(name);
        let mut gpu = Gpu::new(&device.0, &device.1, FEW as u32).expect("a GPU");
        gpu.pad(5);
        let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
        simulation.step(1).expect("a step");
        fill(&mut simulation, &columns(), 17);
        let plans = setup.plans(simulation.backend().machine()).expect("plans");
        let declared = Columns::with(columns()).expect("columns");
        let shared = Rc::new(RefCell::new(simulation));
        let mut seen: Vec<String> = Vec::new();
        let [before, after] = [&plans.measure.0, &plans.measure.1];
        let kernels = [&plans.step, before, after].into_iter().flat_map(|plan| &plan.kernels);
        // Where all live, the watch runs before the step is counted.
        let alive = living(name).plans(shared.borrow_mut().backend().machine()).expect("plans").step;
        let early = alive.kernels.into_iter().filter(|kernel| kernel.name.starts_with("watch ")).filter(of_columns);
        for kernel in early.filter(|_| name == "rk4") {
            watches(&shared, &kernel, &declared, stages);
        }
        for kernel in kernels.filter(|kernel| of_columns(kernel)) {
            // Of the parts of a step one shows as much as another.
            let words = kernel.name.split(' ').take(2).collect::<Vec<_>>().join(" ");
            if seen.contains(&words) || stages.iter().any(|stage| stage.name == words) {
                continue;
            }
            seen.push(words.clone());
            if kernel.name.starts_with("watch") {
                watches(&shared, kernel, &declared, stages);
                continue;
            }
            let plan = alone(kernel.clone());
            let mut random = Random::new(23);
            let others = plan.fields(FEW as u32).into_keys();
            let others = others
                .filter(|name| declared.get(name).is_none() && !["world", "life", "held"].contains(&name.as_str()));
            for name in others {
                let mut simulation = shared.borrow_mut();
                let gpu = simulation.backend();
                let some: Vec<f32> = (0..gpu.size(&name) / 4).map(|_| random.narrow()).collect();
                gpu.write_bytes(&name, 0, bytemuck::cast_slice(&some)).expect("a field");
            }
            // Between stages, and where a step ends, an orientation is no unit.
            let whole = numbers(declared.get("orientation").expect("bodies"), FEW, 37);
            if let ("slopes" | "unit", Array::Vec4(all)) = (words.split(' ').next().unwrap_or_default(), &whole) {
                let long = all.iter().enumerate().map(|(i, q)| *q * (0.8 + (i % 5) as f64 * 0.11)).collect();
                shared.borrow_mut().backend().write("orientation", &Array::Vec4(long)).expect("a column");
            }
            stages.push(Stage::amid(&words, &shared, plan));
            shared.borrow_mut().backend().write("orientation", &whole).expect("a column");
        }
    }
}

/// Numbers that are none, in the components of a column and beside them; after fewer steps than before, as many, and more.
fn watches(shared: &Rc<RefCell<Simulation<Gpu>>>, kernel: &Kernel, columns: &Columns, stages: &mut Vec<Stage>) {
    let name = kernel.name.split(' ').nth(1).expect("a column");
    let column = columns.get(name).expect("a column");
    let buffer = columns.get(&column.place.buffer).expect("a buffer");
    // One step is done, and the kernel may count another.
    let ahead = kernel.passes[0].constants.contains(&("AHEAD", 1.0));
    let done = 1 + u32::from(ahead);
    let cases = [
        ([u32::MAX; 2], 3, f64::NAN),
        ([0, 50], 42, f64::INFINITY),
        ([done, 50], 42, f64::NEG_INFINITY),
        ([done, 490], 42, f64::NAN),
        ([9, 490], FEW - 1, f64::NAN),
    ];
    for (case, (alarm, id, value)) in cases.into_iter().enumerate() {
        let whole = numbers(buffer, FEW, 31);
        let broken = match whole.clone() {
            Array::Float(mut all) => {
                let slots = all.len() / FEW;
                all[id * slots + slots / 2] = value;
                Array::Float(all)
            }
            Array::Vec4(mut all) => {
                all[id][case % 4] = value;
                Array::Vec4(all)
            }
            other => panic!("{other:?}"),
        };
        let mut words = QUIET;
        words[..2].copy_from_slice(&alarm);
        let mut simulation = shared.borrow_mut();
        put(&mut simulation, ALARM, &words);
        simulation.backend().write(&buffer.name, &broken).expect("a column");
        drop(simulation);
        stages.push(Stage::amid(&format!("{} {done} {case}", kernel.name), shared, alone(kernel.clone())));
        shared.borrow_mut().backend().write(&buffer.name, &whole).expect("a column");
    }
}
