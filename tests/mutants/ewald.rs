//! Stages in a periodic cube: gravity and charges of all images, each of their kernels alone, and far groups through a tree.
#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

use glam::{DVec3, Vec4};
use motes::forces::{Component, Problem};
use motes::integrators::Step;
use motes::kernel::{Backend, Elastic, LIFE, Machine, Plan, World};
use motes::settings::Value;
use motes::{Bounds, Gpu, POSITION, Side, Simulation};

use crate::stages::{Device, FEW, Stage, fill, moving, put, stage};
use crate::support::machines::{alone, subgroups_of_eight};
use crate::support::states::{force, word};
use crate::support::{Random, Shared};

const SIDE: f64 = 1.75;
/// By the fitted taper, and by the one for any accuracy.
const COARSE: f64 = 1e-3;
const FINE: f64 = 1e-8;
/// As many waves as there is room for beside a tree.
const FINE_TREE: f64 = 8e-5;

fn cube() -> Bounds {
    let low = DVec3::new(-0.4, 2.5, 0.3);
    Bounds::new(low, low + SIDE, Side::Periodic)
}

fn gravity(over: &'static str, accuracy: f64, hubble: f64) -> Vec<Box<dyn Component>> {
    let settings = [
        ("g", Value::Number(1.3)),
        ("softening", Value::Number(0.17)),
        ("over", word(over)),
        ("theta", Value::Number(0.9)),
        ("images", word("ewald")),
        ("accuracy", Value::Number(accuracy)),
        ("hubble", Value::Number(hubble)),
    ];
    vec![force("gravity", &settings)]
}

/// All over the cube, and a side away from it.
fn spread(device: &Device, count: usize, machine: Machine) -> Simulation<Gpu> {
    within(device, count, machine, 1.5)
}

/// Up to so many sides from the middle of the cube.
fn within(device: &Device, count: usize, machine: Machine, reach: f64) -> Simulation<Gpu> {
    let mut simulation = moving(device, count, Some(machine));
    let clock = pollster::block_on(simulation.backend().world()).expect("a clock");
    simulation.backend().set_world(World { bounds: cube(), time: 3.7, ..clock }).expect("a world");
    let mut random = Random::new(7);
    let places: Vec<Vec4> = (0..count)
        .map(|_| (cube().low + SIDE * (0.5 + reach * random.vector())).as_vec3().extend(0.3 + 0.1 * random.narrow()))
        .collect();
    simulation.write(POSITION, &places).expect("places");
    simulation
}

/// Charges of which bonds leave out some pairs, shorter and longer than the range; the window with all of its coefficients, and with few; and waves
/// of a box that may grow.
fn charges(device: &Device, stages: &mut Vec<Stage>) {
    let elastic = Some(Elastic { least: 0.9, most: 1.2, start: cube().period() });
    for (accuracy, exclude, over, elastic) in
        [(1e-3, 2.0, "list", None), (FINE, 0.0, "within", None), (1e-3, 0.0, "list", elastic)]
    {
        let settings = [
            ("range", Value::Number(0.8)),
            ("coulomb", Value::Number(1.3)),
            ("accuracy", Value::Number(accuracy)),
            ("exclude", Value::Number(exclude)),
            ("over", word(over)),
            ("images", word("ewald")),
        ];
        let forces = vec![force("coulomb", &settings)];
        // In the box that may grow, fewer than there are waves.
        let count = if elastic.is_some() { 70 } else { FEW };
        let mut state = crate::support::cloud(count, 11);
        state.links = crate::support::links(count);
        state.declare(&forces[0].columns()[0]).expect("a column");
        let integrator = crate::support::states::integrator("symplectic_euler");
        let setup =
            motes::Setup { state, forces, integrator, dt: 0.01, bounds: cube(), solver: motes::Solver::default() };
        let problem = setup.problem(Machine::HOST).expect("a problem").stretched(elastic);
        let problem = problem.with_life(&[], &[], elastic.is_some());
        let of = motes::component::Stage::Virial { earlier: 0 };
        let (mut plan, mut virial) = (Plan::default(), Plan::default());
        let evaluate = motes::component::Stage::Evaluate { earlier: 0 };
        setup.forces[0].stage(evaluate, &mut plan, &problem).expect("a plan");
        setup.forces[0].stage(of, &mut virial, &problem).expect("a plan");
        // The law between two has its stage where all of its coefficients count, and its images where waves are few.
        let images = over == "list";
        let mut kernels = plan.kernels;
        kernels.retain(|kernel| kernel.name.starts_with("coulomb ") == images);
        kernels.extend(virial.kernels.into_iter().filter(|_| images));
        for kernel in kernels {
            let name = format!("all images of charges to {accuracy:e}, {}", kernel.name);
            // Phases are rounded with places, and forces are divided by masses.
            let mut simulation = within(device, count, Machine::HOST, 0.5);
            let mut places = pollster::block_on(simulation.read(POSITION)).expect("places");
            places[5].w = 0.0;
            simulation.write(POSITION, &places).expect("places");
            let plan = alone(kernel);
            fill(&mut simulation, &plan);
            if plan.fields(count as u32).contains_key(LIFE.name) {
                let life: Vec<u32> = (0..count as u32).map(|i| u32::from(i % 5 != 3)).collect();
                put(&mut simulation, LIFE, &life);
            }
            stages.push(Stage::of(&name, simulation, plan));
        }
    }
}

pub fn all(shared: &Shared, device: &Device, stages: &mut Vec<Stage>) {
    charges(device, stages);
    let machine = Machine::HOST;
    let problem = |machine, count: usize| Problem::new(u32::try_from(count).expect("few"), machine).at(&[], cube());
    // In a space that expands, and in one that does not.
    for (accuracy, hubble) in [(COARSE, 0.0), (FINE, 0.0), (COARSE, 2.0), (FINE, 2.0)] {
        let mut plan = Plan::default();
        gravity("pairs", accuracy, hubble)[0]
            .stage(motes::component::Stage::Evaluate { earlier: 0 }, &mut plan, &problem(machine, FEW))
            .expect("a plan");
        // The waves are summed by the same kernels, however many they are.
        for kernel in plan.kernels.into_iter().filter(|kernel| accuracy == COARSE || kernel.name == "gravity_ewald") {
            let name = format!("all images to {accuracy:e}, H = {hubble}, {}", kernel.name);
            stages.push(stage(&name, spread(device, FEW, machine), kernel));
        }
    }
    for accuracy in [COARSE, FINE_TREE].into_iter().filter(|_| subgroups_of_eight(shared)) {
        let machine = Machine { subgroup: 8, ..machine };
        let forces = gravity("tree", accuracy, 0.0);
        let mut step = Step::new(&forces, problem(machine, FEW));
        step.evaluate();
        let plan = step.finished().expect("a plan");
        let mut simulation = spread(device, FEW, machine);
        // So close that groups are evaluated as one, and some not at all.
        let mut places = pollster::block_on(simulation.read(POSITION)).expect("places");
        let middle = (cube().low + 0.5 * SIDE).as_vec3();
        for x in &mut places {
            *x = (middle + 0.2 * (x.truncate() - middle)).extend(x.w);
        }
        simulation.write(POSITION, &places).expect("places");
        fill(&mut simulation, &plan);
        // The tree stands when the walk begins.
        let gpu = simulation.backend();
        let program = gpu.compile(&plan).expect("a good plan");
        gpu.run(&program, 1).expect("a run");
        let walk = plan.kernels.into_iter().find(|kernel| kernel.name == "gravity_ewald").expect("a walk");
        stages.push(Stage::new(&format!("all images to {accuracy:e}, far groups"), simulation, walk));
    }
}
