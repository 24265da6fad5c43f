//! Stages of ions on a lattice, and of thermostats.
#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

use glam::{DVec3, Vec4};
use motes::forces::{Component, Problem, Stage as Of};
use motes::kernel::{Backend, Columns, Kernel, Machine, POSITION, Plan, World};
use motes::motion::{Held, Hold};
use motes::settings::{Settings, Value};
use motes::{Bounds, Gpu, Simulation};

use crate::laws::resting;
use crate::stages::{Device, FEW, Stage, fill, moving, stage};
use crate::support::equivalents::{Equivalent, same};
use crate::support::machines::alone;
use crate::support::states::force;
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
    same("wca.wgsl", "if square >= pair.range", ">=", ">", EDGE),
    same("potential.wgsl", "const SMALLEST: f32", "1e-36", "1.4999999999999999e-36", "any small number serves"),
    same("truncation.wgsl", "|| r <= onset", "<=", "<", EDGE),
    same("truncation.wgsl", "override SMOOTHED: bool = true;", "true", "false", ALWAYS_SET),
    same("truncation_square.wgsl", "override SHIFTED: bool = false;", "false", "true", ALWAYS_SET),
];

pub fn number(x: f64) -> Value {
    Value::Number(x)
}

pub fn few() -> u32 {
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
    crate::grains::all(&pollster::block_on(support::limited(shared, |_| {})), device, stages);
    thermostats(device, stages);
    baths(device, stages);
    relaxation(device, stages);
    rescaling(device, stages);
    crate::minimum::all(device, stages);
    crate::barostats::all(&pollster::block_on(support::limited(shared, |_| {})), stages);
}
