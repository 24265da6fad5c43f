//! Stages of ions on a lattice, of grains that touch, and of a thermostat.
#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

use glam::{DVec3, Vec4};
use motes::forces::{Component, Problem, Stage as Of};
use motes::kernel::{Array, Backend, Columns, Kernel, Machine, POSITION, Plan, VELOCITY, World};
use motes::motion::{Held, Hold};
use motes::settings::{Settings, Value};
use motes::{Bounds, Gpu, Setup, Side, Simulation, Solver};

use crate::laws::resting;
use crate::stages::{Device, FEW, Stage, fill, moving, stage};
use crate::support::equivalents::{Equivalent, same};
use crate::support::machines::alone;
use crate::support::states::{force, integrator};
use crate::support::{self, Random, Shared, choices};

const ALWAYS_SET: &str = "the host sets every override";
const EDGE: &str = "no pair lies exactly at the edge";

pub const EQUIVALENT: &[Equivalent] = &[
    same("csvr.wgsl", "override REMOVED: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("csvr.wgsl", "override TEMPERATURE: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("csvr.wgsl", "if REMOVED > 0.0", "0.0", "1.0", "none, or two or three"),
    same("csvr.wgsl", "if sqrt(1.0 - lost) + along < 0.0", "<", "<=", "it is never exactly 0"),
    same("csvr.wgsl", "override TIME: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("csvr_noise.wgsl", "override SEED_LOW: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("csvr_noise.wgsl", "override SEED_HIGH: u32 = 0u;", "0u", "1u", ALWAYS_SET),
    same(
        "virial.wgsl",
        "let force = me.mass * (pair_finish(me, pair)",
        "-",
        "+",
        "the force of no neighbours is none here",
    ),
    same(
        "virial.wgsl",
        "let force = me.mass * (pair_finish(me, sum.whole)",
        "-",
        "+",
        "the force of no neighbours is none here",
    ),
    same("bath.wgsl", "override TEMPERATURE: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("langevin.wgsl", "override FRICTION: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("andersen.wgsl", "override RATE: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("bath.wgsl", "override SEED_LOW: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("bath.wgsl", "override SEED_HIGH: u32 = 0u;", "0u", "1u", ALWAYS_SET),
    same("andersen.wgsl", "if fraction(words_of", ">=", ">", "no number is exactly the probability"),
    same("normals.wgsl", "let uniform_numbers = ", "0.5", "0.75", "a quarter of 2^-24 is nothing to a logarithm"),
    same("decayed.wgsl", "if x > 0.5", ">", ">=", "both formulas hold there"),
    same("decayed.wgsl", "if x > 0.5", "0.5", "0.75", "both formulas hold between"),
    same("berendsen.wgsl", "override DIMENSIONS: f32 = 3.0;", "3.0", "4.5", ALWAYS_SET),
    same("berendsen.wgsl", "override REMOVED: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("berendsen.wgsl", "override TEMPERATURE: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("berendsen.wgsl", "override TIME: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("nose_hoover.wgsl", "override DIMENSIONS: f32 = 3.0;", "3.0", "4.5", ALWAYS_SET),
    same("nose_hoover.wgsl", "override REMOVED: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same("nose_hoover.wgsl", "override TEMPERATURE: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("nose_hoover.wgsl", "override TIME: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same(
        "nose_hoover.wgsl",
        "{ turn(CHAIN - 1u - n,",
        "<",
        "<=",
        "what is written behind the end of the chain is dropped",
    ),
    same("nose_hoover.wgsl", "override CHAIN: u32 = 3u;", "3u", "4u", ALWAYS_SET),
    same("wca.wgsl", "if distance >= pair.range", ">=", ">", EDGE),
    same("potential.wgsl", "const SMALLEST: f32", "1e-36", "1.4999999999999999e-36", "any small number serves"),
    same("truncation.wgsl", "if r <= onset", "<=", "<", EDGE),
    same("contact.wgsl", "if overlap > 0.0", ">", ">=", EDGE),
    same("touch.wgsl", "return overlap > -0.0625", ">", ">=", EDGE),
    same("touch.wgsl", "var impulse = 0.0", "0.0", "1.0", "of two without mass neither counts what is dissipated"),
    same("touch.wgsl", "if abs(against) > most {", ">", ">=", "at the limit the torque is the limit"),
    same("touch.wgsl", "if size > limit", ">", ">=", "at the limit it is the limit either way"),
    same("contact_wall.wgsl", "override WORDS: u32 = 3u", "3u", "4u", ALWAYS_SET),
    same("contact_wall.wgsl", "if params.contacts > 1u", "1u", "2u", "there are 1 or 3"),
    same(
        "contact_wall.wgsl",
        "select(1.0, -1.0, own[contact] >= 0.0)",
        ">=",
        ">",
        "no centre lies exactly in the middle",
    ),
    same(
        "contact_wall.wgsl",
        "if word < WORDS { return",
        "<",
        "<=",
        "a word that is not kept belongs to a spring without stiffness",
    ),
    same(
        "contact_wall.wgsl",
        "return 0.0;",
        "0.0",
        "1.0",
        "a word that is not kept belongs to a spring without stiffness",
    ),
    same("contact_wall.wgsl", "0u, params.stiffness", "0u", "1u", "it is not read"),
    same(
        "contact_wall.wgsl",
        "let next = place(me.index, world.step + 1u",
        "+",
        "-",
        "the other half is the other half",
    ),
    same("contact_wall.wgsl", "if overlap > 0.0", ">", ">=", EDGE),
    same("touch.wgsl", "if sprung && pair.rolling > 0.0", ">", ">=", "a spring without stiffness gives no torque"),
    same("touch.wgsl", "if pair.torsion > 0.0", ">", ">=", "a spring without stiffness gives no torque"),
    same("touch.wgsl", "var twist = 0.0", "0.0", "1.0", "without torsion its word is not read"),
    same("touch.wgsl", "if most > rolling_limit", ">", ">=", "at the limit it is the limit either way"),
];

/// Angular velocities and radii.
const SPINS: motes::kernel::Field<Vec4> = motes::kernel::Field::new("angular_velocity");

fn number(x: f64) -> Value {
    Value::Number(x)
}

fn few() -> u32 {
    u32::try_from(FEW).expect("few")
}

/// Atoms a little off the places of a lattice, one of them without mass.
fn atoms(name: &'static str, device: &Device, stages: &mut Vec<Stage>) {
    let entry = motes::forces::entry(name).expect("it");
    let within = |settings: &Settings| settings.text("over") == "within" && settings.text("mixing") != "none";
    for mut settings in choices::variants(entry.keys).into_iter().filter(within) {
        if entry.keys.iter().any(|key| key.name == "onset") {
            settings = settings.with("onset", number(0.75));
        }
        let law = (entry.build)(&settings).laws().remove(0);
        let mut simulation = resting(device, Machine::HOST, Bounds::default());
        let mut random = Random::new(17);
        let place = |i: usize| {
            let cell = DVec3::new((i % 8) as f64, (i / 8 % 8) as f64, (i / 64) as f64);
            0.8 * (cell + 0.2 * random.vector())
        };
        let places: Vec<DVec3> = (0..FEW).map(place).collect();
        let mass = |i: usize| if i == 13 { 0.0 } else { 0.7 + 0.2 * (i % 3) as f64 };
        let mut now: Vec<Vec4> = places.iter().enumerate().map(|(i, x)| x.extend(mass(i)).as_vec4()).collect();
        if name == "soft" {
            now[9] = now[8];
        }
        simulation.write(POSITION, &now).expect("places");
        let problem = Problem::new(few(), Machine::HOST).of_species(&support::species(FEW));
        let virial = law.virial(&problem).expect("a virial");
        stages.push(stage(name, simulation, law.kernel(&problem).expect("a kernel")));
        if name == "soft" && stages.iter().all(|stage| stage.name != "virial") {
            let mut simulation = resting(device, Machine::HOST, Bounds::default());
            simulation.write(POSITION, &now).expect("places");
            stages.push(stage("virial", simulation, virial.expect("pairs")));
            let simulation = resting(device, Machine::HOST, Bounds::default());
            stages.push(stage("virial clear", simulation, motes::visit::clear_virial(&problem).expect("a kernel")));
        }
    }
}

/// Grains some steps on their way, of which two are at one place, some without mass touch, and some light ones.
fn grains(device: &Device, stages: &mut Vec<Stage>) {
    let linear = |friction: f64, spring: f64| (friction, spring, "linear", "constant", [0.0, 0.0]);
    let some = [linear(0.4, 0.3), linear(0.03, 0.35), linear(0.3, 0.0), linear(0.2, 0.002)];
    // Rolling and torsion that hold, and that yield; each alone.
    let rolling = [
        (0.4, 0.3, "hertz", "elastic_plastic", [0.6, 0.7]),
        (0.3, 0.3, "hertz", "elastic_plastic", [0.02, 0.03]),
        (0.3, 0.3, "linear", "elastic_plastic", [0.3, 0.0]),
        (0.3, 0.3, "linear", "constant", [0.3, 0.2]),
    ];
    for (friction, spring, model, rolling_model, [rolling, torsion]) in some.into_iter().chain(rolling) {
        let settings = [
            ("range", number(1.0)),
            ("skin", number(0.9)),
            ("stiffness", number(300.0)),
            ("restitution", number(0.6)),
            ("friction", number(friction)),
            ("tangential_stiffness", number(spring)),
            ("tangential_damping", number(0.7)),
            ("model", model.into()),
            ("young_modulus", number(2000.0)),
            ("poisson_ratio", number(0.3)),
            ("rolling_model", rolling_model.into()),
            ("rolling_friction", number(rolling)),
            ("rolling_damping", number(0.4)),
            ("torsional_friction", number(torsion)),
        ];
        let mut random = Random::new(5);
        let mut state = motes::State::default();
        for i in 0..FEW {
            let cell = DVec3::new((i % 8) as f64, (i / 8 % 8) as f64, (i / 64) as f64);
            let single = |v: DVec3| v.as_vec3().as_dvec3();
            let mass = match i {
                20 | 21 | 28 | 29 => 0.0,
                40 | 41 | 48 | 49 => 0.3125,
                _ => f64::from((1.0 + 0.4 * random.next()) as f32),
            };
            state.push(single(0.8 * cell + 0.06 * random.vector()), single(random.vector()), mass, 0.01);
        }
        let law: Box<dyn Component> = force("contact", &settings);
        support::columns::give(&mut state, &law.columns(), 7);
        let radius = |i: usize| if i == 100 { 0.0 } else { 0.4375 + 0.015_625 * (i % 5) as f64 };
        state.set("radius", Array::Float((0..FEW).map(radius).collect())).expect("radii");
        let (bounds, solver) = (Bounds::default(), Solver::default());
        let setup =
            Setup { state, forces: vec![law], integrator: integrator("leapfrog"), dt: 1.0 / 256.0, bounds, solver };
        let mut gpu = Gpu::new(&device.0, &device.1, few()).expect("a GPU");
        gpu.pad(5);
        let machine = gpu.machine();
        let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
        simulation.step(5).expect("steps");
        let mut places = pollster::block_on(simulation.read(POSITION)).expect("places");
        // Elsewhere than where they were evaluated last, though on the same list.
        for x in &mut places {
            *x += (0.02 * random.vector()).as_vec3().extend(0.0);
        }
        // No farther from their places than the list knows.
        let middle = 0.5 * (places[8] + places[9]);
        places[8] = middle.truncate().extend(places[8].w);
        places[9] = middle.truncate().extend(places[9].w);
        // A point in a sphere.
        places[100] = (places[101].truncate() + glam::Vec3::new(0.25, 0.125, 0.0)).extend(places[100].w);
        // Contacts that have just ended as spheres part, and some that are farther apart than a step leads.
        let mut velocities = pollster::block_on(simulation.read(VELOCITY)).expect("velocities");
        for (k, i) in [160, 162, 164, 166, 226, 228, 232, 234].into_iter().enumerate() {
            let (sum, reduced) = (radius(i) + radius(i + 1), radius(i) * radius(i + 1) / (radius(i) + radius(i + 1)));
            let gap = if k % 2 == 0 { 1e-3 } else { 1.25 / 16.0 * reduced };
            let way = (places[i + 1] - places[i]).truncate().normalize();
            places[i + 1] = (places[i].truncate() + (sum + gap) as f32 * way).extend(places[i + 1].w);
            velocities[i + 1] = (velocities[i].truncate() + 1.5 * way).extend(velocities[i + 1].w);
        }
        simulation.backend().write_bytes(VELOCITY.name, 0, bytemuck::cast_slice(&velocities)).expect("velocities");
        simulation.backend().write_bytes(POSITION.name, 0, bytemuck::cast_slice(&places)).expect("places");
        // Some that do not roll on each other.
        let mut spins = pollster::block_on(simulation.read(SPINS)).expect("spins");
        spins[..12].iter_mut().for_each(|spin| *spin = Vec4::ZERO.with_w(spin.w));
        simulation.backend().write_bytes(SPINS.name, 0, bytemuck::cast_slice(&spins)).expect("spins");
        let plans = setup.plans(machine).expect("plans");
        let kernel = plans.step.kernels.into_iter().find(|kernel| kernel.name == "contact").expect("a contact");
        // An overlap is the small difference of radii and a distance, and ψ at its limit that of two torques.
        stages.push(Stage::of("grains", simulation, alone(kernel)).slack(8.0));
    }
}

/// Walls of all shapes, still and swinging, that grains touch, some of them without mass; a centre on the axis of a tube.
fn walls(device: &Device, stages: &mut Vec<Stage>) {
    let word = |text: &'static str| Value::Text(text.into());
    let vector = |x: f64, y: f64, z: f64| Value::Vector(DVec3::new(x, y, z));
    let sticky = [("rolling_friction", number(0.3)), ("torsional_friction", number(0.2))];
    let plane = [("shape", word("plane")), ("normal", vector(0.3, -0.2, 0.9))];
    let block = [("shape", word("box")), ("size", vector(1.2, 0.9, 1.4)), ("species", number(1.0))];
    let container = [("shape", word("box")), ("size", vector(2.5, 2.0, 1.75)), ("inside", Value::Flag(true))];
    let ball = [("shape", word("sphere")), ("radius", number(1.5)), ("inside", Value::Flag(true))];
    let capsule = [("shape", word("capsule")), ("radius", number(0.5)), ("axis", vector(0.3, 0.8, -0.2))];
    let cone = [
        ("shape", word("cone")),
        ("radius", number(0.3)),
        ("end_radius", number(1.1)),
        ("axis", vector(0.1, -0.2, 0.9)),
    ];
    let tube = [
        ("shape", word("cone")),
        ("radius", number(0.25)),
        ("end_radius", number(0.25)),
        ("axis", vector(0.0, 0.0, 2.0)),
    ];
    let swing = [("motion", word("swing")), ("friction", number(0.2))];
    let open = Bounds::default();
    // Grains on the other side of the box touch the images of a ball.
    let periodic = Bounds::new(DVec3::splat(-1.5), DVec3::splat(1.5), Side::Periodic);
    let all = [
        ([&plane[..], &sticky].concat(), open),
        ([&container[..], &sticky, &swing].concat(), open),
        ([&container[..], &[("friction", number(0.02))]].concat(), open),
        ([&block[..], &swing].concat(), open),
        (ball.to_vec(), open),
        (capsule.to_vec(), open),
        ([&cone[..], &swing].concat(), open),
        (tube.to_vec(), open),
        ([&plane[..], &swing].concat(), periodic),
        (vec![("shape", word("sphere")), ("radius", number(0.5)), ("position", vector(1.25, -1.0, 1.5))], periodic),
    ];
    for (more, bounds) in all {
        let given = [
            ("stiffness", number(300.0)),
            ("tangential_stiffness", number(0.3)),
            ("position", vector(0.125, -0.25, 0.25)),
        ];
        let wall: Box<dyn Component> = force("contact_wall", &[&given[..], &more].concat());
        let mut random = Random::new(5);
        let mut state = motes::State::default();
        for i in 0..FEW {
            let single = |v: DVec3| v.as_vec3().as_dvec3();
            let mass = if i % 20 == 0 { 0.0 } else { f64::from((1.0 + 0.4 * random.next()) as f32) };
            state.push(single(1.4 * random.vector()), single(random.vector()), mass, 0.01);
        }
        state.species_mut().copy_from_slice(&support::species(FEW));
        state.motions = vec![choices::swing()];
        let columns = [wall.columns(), wall.own_columns(0)].concat();
        support::columns::give(&mut state, &columns, 7);
        let radius = |i: usize| if i % 16 == 3 { 0.0 } else { 0.4375 + 0.015_625 * (i % 5) as f64 };
        state.set("radius", Array::Float((0..FEW).map(radius).collect())).expect("radii");
        let solver = Solver::default();
        let setup =
            Setup { state, forces: vec![wall], integrator: integrator("leapfrog"), dt: 1.0 / 256.0, bounds, solver };
        let machine = simulation_at(device, &setup, 0).backend().machine();
        let plans = setup.plans(machine).expect("plans");
        for kernel in plans.step.kernels.into_iter().filter(|kernel| kernel.name.contains("wall")) {
            let mut simulation = simulation_at(device, &setup, 3);
            if more.starts_with(&plane) && bounds == open {
                lifted(&mut simulation, DVec3::new(0.3, -0.2, 0.9).normalize(), radius);
            }
            // What is dissipated is the difference of the power of forces and of what springs gain.
            stages.push(Stage::of("wall", simulation, alone(kernel)).slack(30.0));
        }
    }
}

fn simulation_at(device: &Device, setup: &Setup, steps: u32) -> Simulation<Gpu> {
    let mut gpu = Gpu::new(&device.0, &device.1, few()).expect("a GPU");
    gpu.pad(5);
    let mut simulation = Simulation::on(gpu, setup).expect("a simulation");
    simulation.step(steps).expect("steps");
    // Some exactly on the axis and on the surface of the tube, on its way up.
    let mut places = pollster::block_on(simulation.read(POSITION)).expect("places");
    for (i, x) in [(7, 0.125), (8, 0.375), (9, 0.375), (10, 0.125)] {
        places[i] = Vec4::new(x, -0.25, 0.5 - 0.03125 * i as f32, places[i].w);
    }
    simulation.backend().write_bytes(POSITION.name, 0, bytemuck::cast_slice(&places)).expect("places");
    simulation
}

/// Lifts some grains that touch a plane off it by less than a sixteenth of their radius: their contacts have just ended.
fn lifted(simulation: &mut Simulation<Gpu>, normal: DVec3, radius: impl Fn(usize) -> f64) {
    let mut places = pollster::block_on(simulation.read(POSITION)).expect("places");
    let mut count = 0;
    for (i, place) in places.iter_mut().enumerate().take(FEW) {
        let above = (place.truncate().as_dvec3() - DVec3::new(0.125, -0.25, 0.25)).dot(normal);
        if i % 3 == 0 && above < 0.9 * radius(i) {
            let x = place.truncate().as_dvec3() + (1.03 * radius(i) - above) * normal;
            *place = x.as_vec3().extend(place.w);
            count += 1;
        }
    }
    assert!(count > 10, "{count} contacts have ended");
    simulation.backend().write_bytes(POSITION.name, 0, bytemuck::cast_slice(&places)).expect("places");
}

/// Each kernel of a thermostat, where some particles are fixed and one has no mass; and one that has nothing to regulate.
fn thermostats(device: &Device, stages: &mut Vec<Stage>) {
    let settings = [("temperature", number(0.7)), ("time", number(0.4)), ("removed", number(6.0))];
    let held = [3, 64, 130].map(|id| Held { id, by: Hold::Fixed });
    let thermostat: Box<dyn Component> = force("nose_hoover", &settings);
    for held in [&held[..], &[]] {
        let problem = Problem::new(few(), Machine::HOST)
            .tied(&motes::links::Links::default(), held)
            .of_columns(Columns::with(thermostat.columns()).expect("columns"));
        let mut plan = Plan::default();
        thermostat.stage(Of::EndOfStep, &mut plan, &problem).expect("an end");
        for kernel in plan.kernels {
            // Many degrees of freedom, three quarters of one, none, and fewer.
            for total in
                [[150.0_f32, 60.0, 0.0, 0.0], [3.0, 2.25, 0.0, 0.0], [3.0, 2.0, 0.0, 0.0], [3.0, 1.0, 0.0, 0.0]]
            {
                let advances = kernel.names("thermostat_rate");
                if total[1] > 50.0 || advances {
                    stages.push(thermostat_at(device, &kernel, total));
                }
            }
        }
    }
}

fn thermostat_at(device: &Device, kernel: &Kernel, total: [f32; 4]) -> Stage {
    let mut simulation = moving(device, FEW, None);
    let mut places = pollster::block_on(simulation.read(POSITION)).expect("places");
    places[13].w = 0.0;
    simulation.write(POSITION, &places).expect("places");
    let plan = alone(kernel.clone());
    fill(&mut simulation, &plan);
    let gpu = simulation.backend();
    if gpu.size("thermostat_total") > 0 {
        gpu.write_bytes("thermostat_total", 0, bytemuck::cast_slice(&total)).expect("a total");
    }
    Stage::of("thermostat", simulation, plan)
}

/// Baths of single particles, some of which are fixed and one has no mass, in space and in the plane.
fn baths(device: &Device, stages: &mut Vec<Stage>) {
    let held = [3, 64, 130].map(|id| Held { id, by: Hold::Fixed });
    for (name, key) in [("langevin", "friction"), ("andersen", "rate")] {
        for (rate, dimensions, held) in [(3.0, 3, &held[..]), (25.0, 2, &[]), (3.0, 2, &[])] {
            let settings = [("temperature", number(0.7)), (key, number(rate)), ("seed", number(12_884_901_895.0))];
            let problem = Problem::new(few(), Machine::HOST).tied(&motes::links::Links::default(), held);
            let mut plan = Plan::default();
            force(name, &settings).stage(Of::EndOfStep, &mut plan, &problem).expect("an end");
            let kernel = plan.kernels.swap_remove(0);
            let mut simulation = moving(device, FEW, None);
            let mut places = pollster::block_on(simulation.read(POSITION)).expect("places");
            places[13].w = 0.0;
            simulation.write(POSITION, &places).expect("places");
            let plan = alone(kernel);
            fill(&mut simulation, &plan);
            let gpu = simulation.backend();
            let world = pollster::block_on(gpu.world()).expect("a clock");
            let bounds = Bounds { dimensions, ..world.bounds };
            gpu.set_world(World { dt: 0.1, step: 7, bounds, ..world }).expect("a clock");
            stages.push(Stage::of(name, simulation, plan));
        }
    }
}

/// A thermostat that relaxes, at totals of many degrees of freedom, of none, and at rest.
fn relaxation(device: &Device, stages: &mut Vec<Stage>) {
    for time in [0.03, 0.0004] {
        let settings = [("temperature", number(0.7)), ("time", number(time)), ("removed", number(6.0))];
        let thermostat: Box<dyn Component> = force("berendsen", &settings);
        let problem =
            Problem::new(few(), Machine::HOST).of_columns(Columns::with(thermostat.columns()).expect("columns"));
        let mut plan = Plan::default();
        thermostat.stage(Of::EndOfStep, &mut plan, &problem).expect("an end");
        for kernel in plan.kernels.into_iter().filter(|kernel| kernel.names("thermostat_heat")) {
            for total in [
                [150.0_f32, 60.0, 0.0, 0.0],
                [0.0, 60.0, 0.0, 0.0],
                [0.5, 60.0, 0.0, 0.0],
                [3.0, 2.25, 0.0, 0.0],
                [3.0, 2.0, 0.0, 0.0],
                [3.0, 1.0, 0.0, 0.0],
            ] {
                stages.push(thermostat_at(device, &kernel, total));
            }
        }
    }
}

/// A thermostat of random factors: its noise, and factors at chosen sums, one of which turns velocities.
fn rescaling(device: &Device, stages: &mut Vec<Stage>) {
    let held = [3, 64, 130].map(|id| Held { id, by: Hold::Fixed });
    for (time, drift, held) in [(3.0, false, &held[..]), (0.0004, true, &[]), (0.1, true, &[])] {
        let settings = [
            ("temperature", number(0.7)),
            ("time", number(time)),
            ("drift", Value::Flag(drift)),
            ("seed", number(12_884_901_895.0)),
        ];
        let thermostat: Box<dyn Component> = force("csvr", &settings);
        let columns = Columns::with(thermostat.columns()).expect("columns");
        let problem =
            Problem::new(few(), Machine::HOST).tied(&motes::links::Links::default(), held).of_columns(columns);
        let mut plan = Plan::default();
        thermostat.stage(Of::EndOfStep, &mut plan, &problem).expect("an end");
        for kernel in plan.kernels {
            if kernel.name == "csvr noise" {
                let mut simulation = moving(device, FEW, None);
                let mut places = pollster::block_on(simulation.read(POSITION)).expect("places");
                places[13].w = 0.0;
                simulation.write(POSITION, &places).expect("places");
                let plan = alone(kernel);
                fill(&mut simulation, &plan);
                stages.push(Stage::of("csvr noise", simulation, plan));
            } else if kernel.names("thermostat_heat") {
                for (total, work) in [(150.0_f32, -4.0), (150.0, 4.0), (0.0, 4.0), (0.5, -4.0), (3.0, 4.0)] {
                    stages.push(drawn_at(device, &kernel, total, work));
                }
            }
        }
    }
}

fn drawn_at(device: &Device, kernel: &Kernel, twice: f32, work: f32) -> Stage {
    let mut simulation = moving(device, FEW, None);
    let plan = alone(kernel.clone());
    fill(&mut simulation, &plan);
    let put = |simulation: &mut Simulation<Gpu>, name: &str, values: [f32; 4]| {
        simulation.backend().write_bytes(name, 0, bytemuck::cast_slice(&values)).expect(name);
    };
    put(&mut simulation, "thermostat_total", [twice, 60.0, 0.0, 0.0]);
    put(&mut simulation, "thermostat_noise_total", [3.0, -5.0, 2.0, 30.0]);
    put(&mut simulation, "thermostat_work_total", [work, 170.0, 0.0, 0.0]);
    Stage::of("csvr", simulation, plan)
}

pub fn all(shared: &Shared, device: &Device, stages: &mut Vec<Stage>) {
    choices::ATOMS.into_iter().for_each(|name| atoms(name, device, stages));
    // A list of neighbours has more layers than few workgroups allow.
    grains(&pollster::block_on(support::limited(shared, |_| {})), stages);
    walls(device, stages);
    thermostats(device, stages);
    baths(device, stages);
    relaxation(device, stages);
    rescaling(device, stages);
    crate::minimum::all(device, stages);
    crate::barostats::all(&pollster::block_on(support::limited(shared, |_| {})), stages);
}
