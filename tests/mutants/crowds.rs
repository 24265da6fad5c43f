//! Stages of pedestrians.
#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

use glam::{DVec2, DVec3};
use motes::floor_plan::{Exit, FloorPlan, Polygon};
use motes::forces::Component;
use motes::kernel::{Array, Backend, Kernel, Machine, POSITION, Plan, VELOCITY};
use motes::settings::Value;
use motes::{Bounds, Gpu, Setup, Simulation, Solver, State};

use crate::stages::{Device, FEW, Stage};
use crate::support::equivalents::{Equivalent, same};
use crate::support::machines::alone;
use crate::support::states::{force, integrator, vector, word};
use crate::support::{self, Random};

const EDGE: &str = "no pedestrian lies exactly at the edge";
const NO_WALL: &str = "behind the last wall stands that again, or one without length, which is not crossed";
const TWO_WALLS: &str = "a way from floor to floor crosses two walls, or none";
const AT_THE_LEFT: &str = "on the floor, what is beyond an end that does not stick out is at the left of its piece";
const AS_NEAR: &str = "of two that are as near either leaves the same spacing";
const ALWAYS_SET: &str = "the host sets every override";

pub const EQUIVALENT: &[Equivalent] = &[
    same("keep.wgsl", "override COUNT: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("keep.wgsl", "override SPECIES: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("sight.wgsl", "override COUNT: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("sight.wgsl", "var k = 0u", "0u", "1u", TWO_WALLS),
    same("sight.wgsl", "k < COUNT", "<", "<=", NO_WALL),
    same("keep.wgsl", "k < COUNT", "<", "<=", NO_WALL),
    same("exits.wgsl", "override COUNT: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("ways.wgsl", "override COUNT: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("ways.wgsl", "override WIDTH: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("ways.wgsl", "override SIDE: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("ways.wgsl", "if apart < SIDE", "<", "<=", EDGE),
    same("crowds/floor.wgsl", "override COUNT: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("crowds/floor.wgsl", "seen = false;", "false", "true", "the first piece of a wall says whether it is seen"),
    same("crowds/floor.wgsl", "const FAR", "1e9", "1500000000.0", "farther than any wall"),
    same("crowds/floor.wgsl", "if dot(r, r) > clearance", ">", ">=", EDGE),
    same("crowds/floor.wgsl", "hidden = hidden", "0u", "1u", TWO_WALLS),
    same("crowds/floor.wgsl", "hidden = hidden", "<", "<=", NO_WALL).sometimes(),
    same("crowds/floor.wgsl", "let count = min(COUNT", "min", "max", "the table has as many rows").sometimes(),
    same("crowds/floor.wgsl", "if into > 0.0", ">", ">=", "without a direction a pedestrian stays").sometimes(),
    same("crowds/floor.wgsl", "if distance < nearest", "<", "<=", "the end that two pieces share is one point"),
    same("crowds/floor.wgsl", "let left", ">", ">=", EDGE),
    same("crowds/floor.wgsl", "seen = left", "&", "|", AT_THE_LEFT),
    same("crowds/floor.wgsl", "seen = left", ">", ">=", AT_THE_LEFT),
    same("crowds/floor.wgsl", "seen = left", "1u", "2u", AT_THE_LEFT),
    same("crowds/floor.wgsl", "seen = left", "2u", "3u", AT_THE_LEFT),
    same("crowds/floor.wgsl", "seen = left", "0u", "1u", "one of the two bits is 2 or 0").sometimes(),
    same("crowds/floor.wgsl", "if (wall.ends & 4u) > 0u", "0u", "1u", "the bit is 4 or 0"),
    same("crowds/floor.wgsl", "if seen && nearest > 0.0", ">", ">=", EDGE),
    // In one of three loops: what stands there has no distance.
    same("crowds/floor.wgsl", "k < COUNT", "<", "<=", NO_WALL).sometimes(),
    same("collision_free_speed.wgsl", "let is_in_front", ">=", ">", EDGE),
    same("collision_free_speed.wgsl", "let is_in_front", "<=", "<", EDGE),
    same("collision_free_speed.wgsl", "let is_nearest", "<", "<=", AS_NEAR),
    same("collision_free_speed.wgsl", "if part.others > 0u", "<", "<=", AS_NEAR),
    same("collision_free_speed.wgsl", "*sum = Sum(spacing, 1u);", "1u", "2u", "it is asked whether there are any"),
    same("set_off.wgsl", "if i < world.count", "<", "<=", "behind the last particle no word is a speed"),
];

fn number(x: f64) -> Value {
    Value::Number(x)
}

fn few() -> u32 {
    u32::try_from(FEW).expect("few")
}

/// Pedestrians in a square, close enough that many touch; some at rest, two at one place, some without mass, of three species.
fn people() -> State {
    let mut random = Random::new(23);
    let mut state = State::default();
    let single = |v: DVec3| v.as_vec3().as_dvec3();
    for i in 0..FEW {
        let x = single(6.0 * random.vector().with_z(0.0));
        let v = if i % 10 == 3 { DVec3::ZERO } else { single(1.3 * random.vector().with_z(0.0)) };
        let mass = if i % 20 == 7 {
            0.0
        } else if i % 20 == 11 {
            0.5
        } else {
            f64::from((80.0 + 15.0 * random.next()) as f32)
        };
        state.push(x, v, mass, 0.3);
    }
    let twin = state.position()[8];
    state.position_mut()[9] = twin;
    for (column, [middle, half]) in
        [(motes::crowds::radius(), [0.3, 0.05]), (motes::crowds::desired_speed(), [1.34, 0.5])]
    {
        state.declare(&column).expect("a column");
        let all = (0..FEW).map(|_| f64::from((middle + half * random.next()) as f32)).collect();
        state.set(&column.name, Array::Float(all)).expect("values");
    }
    state.species_mut().copy_from_slice(&support::species(FEW));
    state
}

/// The kernels of some components whose names begin so, each in the state after some steps.
fn staged(
    device: &Device,
    stages: &mut Vec<Stage>,
    forces: &[Box<dyn Component>],
    names: &[&str],
    machine: Option<Machine>,
) {
    let bounds = Bounds { dimensions: 2, ..Bounds::default() };
    let (integrator, solver) = (integrator("leapfrog"), Solver::default());
    let setup = Setup { state: people(), forces: forces.to_vec(), integrator, dt: 1.0 / 4096.0, bounds, solver };
    let simulation = || {
        let mut gpu = Gpu::new(&device.0, &device.1, few()).expect("a GPU");
        gpu.pad(5);
        Simulation::on(gpu, &setup).expect("a simulation")
    };
    let machine = machine.unwrap_or_else(|| simulation().backend().machine());
    let plans = setup.plans(machine).expect("plans");
    for kernel in plans.step.kernels.into_iter().filter(|kernel| names.iter().any(|name| kernel.name.starts_with(name)))
    {
        let mut simulation = simulation();
        simulation.step(0).expect("a start");
        stages.push(Stage::of(names[0], simulation, alone(kernel)));
    }
}

/// A floor with corners of all kinds, a thin wall, and a hole; two exits.
fn floor() -> FloorPlan {
    let points = |list: &[[f64; 2]]| -> Vec<DVec2> { list.iter().copied().map(DVec2::from_array).collect() };
    let outline = points(&[
        [-5.0, -4.0],
        // With it the sides of the thin wall have odd numbers, those of the hole even ones.
        [-2.0, -4.15],
        [0.1, -4.25],
        [0.15, 0.5],
        [0.25, 0.5],
        [0.3, -4.25],
        [6.0, -4.0],
        [6.5, -2.0],
        [6.625, 1.0],
        [6.0, 5.0],
        [2.0, 5.0],
        [1.5, 4.0],
        [1.0, 5.0],
        [-5.0, 4.5],
    ]);
    // With sharp tips, whose sides are not both in view.
    let hole = points(&[[-3.5, 0.5], [-0.75, 1.0], [-3.5, 0.75]]);
    let exit = |path: &[[f64; 2]]| Exit { name: "door".to_owned(), path: points(path), reach: 0.25 };
    let exits = vec![exit(&[[5.5, -1.0], [5.75, 1.0]]), exit(&[[-4.5, 3.0], [-4.0, 4.0], [-3.5, 4.0]])];
    FloorPlan::new(&[Polygon { outline, holes: vec![hole] }], exits, 0.37).expect("a floor")
}

/// Pedestrians on that floor, some fixed, some removed; kernels of the start and of steps.
fn on_floor(device: &Device, stages: &mut Vec<Stage>, species: &Value) {
    let plan = floor();
    let mut random = Random::new(29);
    let mut state = people();
    for x in state.position_mut() {
        *x = loop {
            let place = (6.5 * random.vector().with_z(0.0)).as_vec3().as_dvec3();
            if plan.holds(place.truncate()) && plan.distance(place.truncate()) > 0.01 {
                break place;
            }
        };
    }
    state.held = [3, 64, 130].map(|id| motes::motion::Held { id, by: motes::motion::Hold::Fixed }).to_vec();
    let navigate = force("navigate", &[("relaxation_time", number(0.7)), ("species", species.clone())]);
    let wall = [
        ("range", number(1.25)),
        ("repulsion", number(300.0)),
        ("decay", number(0.3)),
        ("stiffness", number(2500.0)),
        ("friction", number(1700.0)),
        ("species", species.clone()),
    ];
    let wall: Box<dyn Component> = force("social_wall", &wall);
    let state = state.on_floor(plan);
    let bounds = Bounds { dimensions: 2, ..Bounds::default() };
    let (integrator, solver) = (integrator("leapfrog"), Solver::default());
    let setup = Setup { state, forces: vec![navigate, wall], integrator, dt: 1.0 / 64.0, bounds, solver };
    let simulation = || {
        let mut gpu = Gpu::new(&device.0, &device.1, few()).expect("a GPU");
        gpu.pad(5);
        let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
        simulation.step(1).expect("a step");
        simulation
    };
    let plans = setup.plans(simulation().backend().machine()).expect("plans");
    let find = |plan: &Plan, name: &str| -> Kernel {
        plan.kernels.iter().find(|kernel| kernel.name == name).unwrap_or_else(|| panic!("no {name}")).clone()
    };
    for name in ["walls begin", "exits", "ways"] {
        let mut simulation = simulation();
        let gpu = simulation.backend();
        gpu.compile(&plans.start).expect("a start");
        if name == "ways" {
            // Too far by up to a cell.
            for field in ["exit_distance", "exit_distance_next"] {
                let bytes = pollster::block_on(gpu.bytes(field, 0, gpu.size(field))).expect("distances");
                let mut far: Vec<f32> = bytemuck::pod_collect_to_vec(&bytes);
                far.iter_mut().filter(|far| **far < 1e9).for_each(|far| *far += 0.2 * (1.0 + random.narrow()));
                gpu.write_bytes(field, 0, bytemuck::cast_slice(&far)).expect("distances");
            }
        }
        if name == "exits" {
            let far = vec![0.5_f32; gpu.size("exit_distance") as usize / 4];
            gpu.write_bytes("exit_distance", 0, bytemuck::cast_slice(&far)).expect("distances");
            gpu.write_bytes("exit_distance_next", 0, bytemuck::cast_slice(&far)).expect("distances");
        }
        stages.push(Stage::of(name, simulation, alone(find(&plans.start, name))));
    }
    for name in ["navigate", "social_wall", "walls keep", "inside"] {
        let mut simulation = simulation();
        if name == "walls keep" {
            let mut places = pollster::block_on(simulation.read(POSITION)).expect("places");
            places.iter_mut().enumerate().filter(|(i, _)| i % 3 > 0).for_each(|(_, x)| {
                *x += (random.vector().with_z(0.0)).as_vec3().extend(0.0);
            });
            simulation.backend().write_bytes(POSITION.name, 0, bytemuck::cast_slice(&places)).expect("places");
        }
        stages.push(Stage::of(name, simulation, alone(find(&plans.step, name))).slack(2.0));
    }
}

/// Pedestrians on that floor, or on an open one, that set their velocities; steps so long that walls stop many.
fn spaced(device: &Device, stages: &mut Vec<Stage>, species: &Value, plan: Option<FloorPlan>) {
    let mut random = Random::new(31);
    let mut state = people();
    for x in state.position_mut() {
        // Nearer, the direction from a wall is mostly rounding.
        let free = |x: DVec2| plan.as_ref().is_none_or(|plan| plan.holds(x) && plan.distance(x) > 0.05);
        *x = loop {
            let place = (6.5 * random.vector().with_z(0.0)).as_vec3().as_dvec3();
            if free(place.truncate()) {
                break place;
            }
        };
    }
    // Two at one place, on an open floor far from the others.
    if plan.is_none() {
        state.position_mut()[8] = DVec3::new(12.0, 12.0, 0.0);
    } else {
        // Some stand close to each other, on two sides of the thin wall.
        for (k, x) in state.position_mut()[20..60].iter_mut().enumerate() {
            let side = if k % 2 == 0 { -0.25 } else { 0.65 };
            *x = DVec3::new(side + 0.125 * random.next(), -4.0 + 0.1 * k as f64, 0.0).as_vec3().as_dvec3();
        }
    }
    let twin = state.position()[8];
    state.position_mut()[9] = twin;
    state.held = [3, 64, 130].map(|id| motes::motion::Held { id, by: motes::motion::Hold::Fixed }).to_vec();
    let drive = if plan.is_some() { "navigate" } else { "walk" };
    let own = [
        ("range", number(2.5)),
        ("time_gap", number(0.7)),
        ("repulsion", number(1.5)),
        ("decay", number(0.3)),
        ("wall_repulsion", number(1.25)),
        ("wall_decay", number(0.2)),
        ("over", word("within")),
        ("species", species.clone()),
    ];
    // Those of one species have no direction that they desire.
    let led = force(drive, &[("species", number(1.0))]);
    let others = force("walk", &[("species", number(2.0)), ("direction", vector(0.3, -0.7, 0.0))]);
    let forces: Vec<Box<dyn Component>> = vec![led, others, force("collision_free_speed", &own)];
    let state = match plan {
        Some(plan) => state.on_floor(plan),
        None => state,
    };
    let bounds = Bounds { dimensions: 2, ..Bounds::default() };
    let (integrator, solver) = (integrator("symplectic_euler"), Solver::default());
    let setup = Setup { state, forces, integrator, dt: 0.25, bounds, solver };
    let simulation = || {
        let mut gpu = Gpu::new(&device.0, &device.1, few()).expect("a GPU");
        gpu.pad(5);
        let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
        simulation.step(1).expect("a step");
        simulation
    };
    let plans = setup.plans(Machine::HOST).expect("plans");
    for name in [drive, "collision_free_speed", "turn aside", "keep spacing", "set off"] {
        let all = plans.step.kernels.iter();
        let kernel = all.clone().find(|kernel| kernel.name == name).unwrap_or_else(|| panic!("no {name}"));
        let mut simulation = simulation();
        if name == "set off" {
            // Those that stop were on their way.
            let mut velocities = pollster::block_on(simulation.read(VELOCITY)).expect("velocities");
            velocities.iter_mut().for_each(|v| *v += random.vector().with_z(0.0).as_vec3().extend(0.0));
            simulation.backend().write_bytes(VELOCITY.name, 0, bytemuck::cast_slice(&velocities)).expect("velocities");
        }
        stages.push(Stage::of(name, simulation, alone(kernel.clone())).slack(8.0));
    }
}

/// Pedestrians all about exits that walls are before, behind and at the end of.
fn behind_walls(device: &Device, stages: &mut Vec<Stage>) {
    let points = |list: &[[f64; 2]]| -> Vec<DVec2> { list.iter().copied().map(DVec2::from_array).collect() };
    let outline =
        points(&[[-2.0, -2.0], [2.0, -2.0], [2.0, 2.0], [0.1, 2.0], [0.2, 0.5], [0.0, 0.3], [-0.1, 2.0], [-2.0, 2.0]]);
    let hole = points(&[[-1.0, -1.25], [0.8, -1.0], [1.0, -0.8], [-0.9, -0.7]]);
    let exit = |path: &[[f64; 2]]| Exit { name: "door".to_owned(), path: points(path), reach: 0.9 };
    let exits =
        vec![exit(&[[0.3, 0.4], [1.0, 1.6]]), exit(&[[-0.9, -0.5], [0.75, -0.6]]), exit(&[[-0.1, 0.15], [0.3, 0.15]])];
    let plan = FloorPlan::new(&[Polygon { outline, holes: vec![hole] }], exits, 0.1).expect("a floor");
    let mut random = Random::new(37);
    let mut state = people();
    for x in state.position_mut() {
        *x = loop {
            let place = (2.0 * random.vector().with_z(0.0)).as_vec3().as_dvec3();
            if plan.holds(place.truncate()) && plan.distance(place.truncate()) > 0.01 {
                break place;
            }
        };
    }
    state.held = [3, 64, 130].map(|id| motes::motion::Held { id, by: motes::motion::Hold::Fixed }).to_vec();
    let bounds = Bounds { dimensions: 2, ..Bounds::default() };
    let (integrator, solver) = (integrator("leapfrog"), Solver::default());
    let setup = Setup { state: state.on_floor(plan), forces: Vec::new(), integrator, dt: 1.0 / 4096.0, bounds, solver };
    let simulation = || {
        let mut gpu = Gpu::new(&device.0, &device.1, few()).expect("a GPU");
        gpu.pad(5);
        Simulation::on(gpu, &setup).expect("a simulation")
    };
    let plans = setup.plans(simulation().backend().machine()).expect("plans");
    for kernel in plans.step.kernels.into_iter().filter(|kernel| kernel.name.starts_with("drain")) {
        stages.push(Stage::of("sight", simulation(), alone(kernel)));
    }
}

/// Ways that begin and end on walls, and pass their ends: all numbers are multiples of a half, so that the side of a wall is exact.
fn on_walls(device: &Device, stages: &mut Vec<Stage>) {
    let outline = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(DVec2::from_array).to_vec();
    let plan = FloorPlan::new(&[Polygon { outline, holes: Vec::new() }], Vec::new(), 0.1).expect("a floor");
    let mut random = Random::new(41);
    let mut state = people();
    state.position_mut().iter_mut().for_each(|x| *x = DVec3::ZERO);
    let bounds = Bounds { dimensions: 2, ..Bounds::default() };
    let (integrator, solver) = (integrator("leapfrog"), Solver::default());
    let forces = vec![force("social_wall", &[])];
    let setup = Setup { state: state.on_floor(plan), forces, integrator, dt: 1.0 / 4096.0, bounds, solver };
    let mut gpu = Gpu::new(&device.0, &device.1, few()).expect("a GPU");
    gpu.pad(5);
    let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
    simulation.step(0).expect("a start");
    let plans = setup.plans(simulation.backend().machine()).expect("plans");
    let mut places = || -> Vec<glam::Vec4> {
        let half = |x: f64| (4.0 * x).round() as f32 / 2.0;
        (0..FEW).map(|_| random.vector()).map(|x| glam::Vec4::new(half(x.x), half(x.y), 0.0, 1.0)).collect()
    };
    for field in [POSITION.name, "allowed_position"] {
        simulation.backend().write_bytes(field, 0, bytemuck::cast_slice(&places())).expect("places");
    }
    let keep = plans.step.kernels.into_iter().find(|kernel| kernel.name == "walls keep").expect("a net");
    stages.push(Stage::of("walls keep", simulation, alone(keep)));
}

pub fn all(device: &Device, stages: &mut Vec<Stage>) {
    on_floor(device, stages, &word("all"));
    on_floor(device, stages, &number(1.0));
    for species in [word("all"), number(1.0)] {
        spaced(device, stages, &species, Some(floor()));
        spaced(device, stages, &species, None);
    }
    behind_walls(device, stages);
    on_walls(device, stages);
    for (species, anisotropy) in [(word("all"), 0.3), (number(1.0), 1.0)] {
        let more = [
            ("over", word("within")),
            ("range", number(1.5)),
            ("repulsion", number(300.0)),
            ("decay", number(0.3)),
            ("stiffness", number(2500.0)),
            ("friction", number(1700.0)),
            ("anisotropy", number(anisotropy)),
            ("species", species.clone()),
        ];
        staged(device, stages, &[force("social_force", &more)], &["social_force"], Some(Machine::HOST));
        for to in ["direction", "target"] {
            let more = [
                ("to", word(to)),
                ("direction", vector(0.3, -0.7, 0.0)),
                ("target", vector(0.4, 0.9, 0.0)),
                ("relaxation_time", number(0.7)),
                ("species", species.clone()),
            ];
            staged(device, stages, &[force("walk", &more)], &["walk"], None);
        }
    }
}
