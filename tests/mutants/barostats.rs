//! Stages of barostats: what they measure, the change that follows, and the box as it changes with its particles.

#![allow(clippy::cast_precision_loss, clippy::cast_possible_truncation, reason = "small numbers")]

use std::sync::Arc;

use glam::{DVec3, DVec4, Vec4};
use motes::forces::Component;
use motes::kernel::{Backend, Field, Host, Kernel, Pass, Plan, VELOCITY, World};
use motes::settings::Value::Number;
use motes::{Bounds, Gpu, POSITION, Setup, Side, Simulation, Solver};

use crate::stages::{Device, FEW, Stage};
use crate::support::Random;
use crate::support::equivalents::{Equivalent, same};
use crate::support::states::{force, integrator, word};

const ALWAYS_SET: &str = "the host sets every override";

pub const EQUIVALENT: &[Equivalent] = &[
    same("barostat/due.wgsl", "override EVERY: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("barostat/due.wgsl", "n += WORKGROUP", "+=", "-=", "there are fewer arguments than lanes"),
    same(
        "barostat/advance.wgsl",
        "select(vec3f(1.0), corner",
        "1.0",
        "1.5",
        "along other axes nothing changes, whatever side there is",
    ),
    same("barostat/advance.wgsl", "let moves =", ">=", ">", "no change is exactly so large"),
    same("barostat/advance.wgsl", "box_go[", "0u", "1u", "a change of 0 moves nothing"),
    same("barostat/scale.wgsl", "let beyond =", ">=", ">", "no particle lies exactly there"),
    same("barostat/measure.wgsl", "override ROUNDING: f32 = 0.0;", "0.0", "1.0", ALWAYS_SET),
    same(
        "updaters/cell_rescaling.wgsl",
        "SEED_HIGH)), 2u).x",
        "2u",
        "3u",
        "the first of them is the same in any dimension",
    ),
    same("barostat/due.wgsl", "override WORDS: u32 = 0u;", "0u", "1u", ALWAYS_SET),
    same("barostat/pressure.wgsl", "override EVERY: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("barostat/advance.wgsl", "override GROUPS: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("barostat/advance.wgsl", "override ROWS: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("updaters/berendsen_pressure.wgsl", "override PRESSURE: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("updaters/berendsen_pressure.wgsl", "override RATE: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("updaters/cell_rescaling.wgsl", "override PRESSURE: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("updaters/cell_rescaling.wgsl", "override TEMPERATURE: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("updaters/cell_rescaling.wgsl", "override RATE: f32 = 1.0;", "1.0", "1.5", ALWAYS_SET),
    same("updaters/cell_rescaling.wgsl", "override SEED_LOW: u32 = 1u;", "1u", "2u", ALWAYS_SET),
    same("updaters/cell_rescaling.wgsl", "override SEED_HIGH: u32 = 0u;", "0u", "1u", ALWAYS_SET),
];

/// Atoms that repel each other softly, two steps on their way in a box that is no cube.
fn simulation(device: &Device, name: &'static str, every: u32, flat: bool) -> (Simulation<Gpu>, Plan, Plan) {
    let mut random = Random::new(5);
    let sides = if flat { DVec3::new(26.0, 31.5, 0.0) } else { DVec3::new(9.5, 8.25, 10.0) };
    // A plane is z = 0, wherever its box is said to be.
    let low = DVec3::new(-1.25, 2.5, if flat { -0.5 } else { -3.75 });
    let mut state = motes::State::default();
    for i in 0..FEW {
        let (x, v) = (0.5 + 0.5 * random.vector(), random.vector());
        let place = (low + sides * x).as_vec3().as_dvec3();
        let place = if flat { place.with_z(0.0) } else { place };
        let still = if flat { DVec3::new(1.0, 1.0, 0.0) } else { DVec3::ONE };
        let mass = if i % 20 == 7 { 0.0 } else { 0.75 + 0.125 * (i % 5) as f64 };
        state.push(place, v.as_vec3().as_dvec3() * still, mass, 0.01);
    }
    let soft = force("soft", &[("range", Number(1.5)), ("strength", Number(3.0)), ("over", word("list"))]);
    let given = [
        ("pressure", Number(2.25)),
        ("compressibility", Number(0.4)),
        ("time", Number(5.0)),
        ("every", Number(f64::from(every))),
        ("temperature", Number(0.7)),
        ("seed", Number(4_294_967_301.0)),
    ];
    let kept = if name == "cell_rescaling" { &given[..] } else { &given[..4] };
    let barostat: Box<dyn Component> = force(name, kept);
    let bounds = Bounds::new(low, low + sides, Side::Periodic);
    let (forces, solver) = (vec![soft, barostat], Solver::default());
    let setup = Setup { state, forces, integrator: integrator("leapfrog"), dt: 1.0 / 64.0, bounds, solver };
    let mut gpu = Gpu::new(&device.0, &device.1, u32::try_from(FEW).expect("few")).expect("a GPU");
    gpu.pad(5);
    let machine = gpu.machine();
    let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
    simulation.step(2).expect("steps");
    let plans = setup.plans(machine).expect("plans");
    (simulation, plans.step, plans.time)
}

/// The parts of the pressure alone, of virials that are given.
fn parts(step: &Plan) -> Kernel {
    let whole = step.kernels.iter().find(|kernel| kernel.name.starts_with("pressure EVERY")).expect("a pressure");
    let ours = |pass: &&Pass| pass.shader.sources().iter().any(|source| source.file.ends_with("barostat/measure.wgsl"));
    let pass = Pass { indirect: None, ..whole.passes.iter().find(ours).expect("its pass").clone() };
    let reference = |host: &Host| {
        let (position, velocity) = (host.read(POSITION)?, host.read(VELOCITY)?);
        let virial = host.read(Field::<Vec4>::new("virial"))?;
        let rows = position.iter().zip(velocity.iter()).zip(virial.chunks_exact(2));
        let mut parts = host.write(Field::<Vec4>::new("pressure_parts"))?;
        for (part, ((x, v), two)) in parts.iter_mut().zip(rows) {
            let fails = if two[0].w > 1e-4 * two[1].w { 1.0 } else { 0.0 };
            *part = DVec4::new(x.w * v.truncate().length_squared(), two[0].x + two[0].y + two[0].z, fails, 0.0);
        }
        Ok(())
    };
    Kernel {
        name: "parts".to_owned(),
        passes: vec![pass],
        reference: Some(Arc::new(reference)),
        tables: Vec::new(),
        ..whole.clone()
    }
}

fn chosen(plan: &Plan, wanted: impl Fn(&Kernel) -> bool) -> Plan {
    Plan::of(plan.kernels.iter().filter(|kernel| wanted(kernel)).cloned())
}

fn put(simulation: &mut Simulation<Gpu>, name: &str, values: &[f32]) {
    simulation.backend().write_bytes(name, 0, bytemuck::cast_slice(values)).expect(name);
}

pub fn all(device: &Device, stages: &mut Vec<Stage>) {
    // A list of neighbours has more layers than few workgroups allow.
    for name in ["berendsen_pressure", "cell_rescaling"] {
        for flat in [false, true] {
            let make = |every| simulation(device, name, every, flat);
            // What is measured, at a step where it is due, and at one where it is not.
            for every in [3, 2] {
                let (simulation, step, _) = make(every);
                let measured = chosen(&step, |kernel| kernel.name.starts_with("pressure EVERY"));
                stages.push(Stage::of("pressure", simulation, measured).slack(8.0));
                // Above and below the pressure that is wanted; the largest change is another one, or this one.
                for (parts, largest) in [([900.0, 450.0], 0.0078125), ([900.0, -400.0], 0.0), ([11.0, 3.5], 0.5)] {
                    let (mut simulation, step, _) = make(every);
                    put(&mut simulation, "pressure_total", &[parts[0], parts[1], 2.0, 0.5]);
                    put(&mut simulation, "box_watch", &[7.5, largest, 1.5, 0.0]);
                    let decided = chosen(&step, |kernel| kernel.name.starts_with(name));
                    stages.push(Stage::of("strain", simulation, decided).slack(4.0));
                }
            }
            // Forces that hardly add up, and forces that hardly do not.
            let (mut simulation, step, _) = make(3);
            let virials: Vec<f32> = (0..FEW)
                .flat_map(|i| {
                    let size = 0.5 + 0.25 * (i % 7) as f32;
                    let part = [0.5, 0.98, 1.02, 2.0, 1e4][i % 5] * 1e-4;
                    [0.25 + i as f32, -1.5, 0.75 * (i % 3) as f32, part * size, 1.0, 2.0, 3.0, size]
                })
                .collect();
            put(&mut simulation, "virial", &virials);
            stages.push(Stage::of("hardly", simulation, Plan::of([parts(&step)])));
            // Larger and smaller, by much too; less than positions resolve, and so with what was left before, of which one side has enough.
            let some = [
                (0.046_875, 9.0, [0.0; 3]),
                (-0.046_875, 9.75, [1e-7, -2e-7, 3e-7]),
                (if flat { 0.7 } else { 1.05 }, 9.0, [0.0; 3]),
                (0.0, 0.0, [0.0; 3]),
                (1.5e-6, 0.0, [2e-5, -1e-5, 2e-5]),
                (1.5e-6, 0.0, [2e-5, -4e-4, 2e-5]),
                (-1.5e-6, 5.0, [3e-3, 1e-5, 2e-5]),
                (0.0, 5.0, [2e-5, 1e-5, 4e-4]),
            ];
            for (strain, side, left) in some {
                let (mut simulation, step, _) = make(1);
                put(&mut simulation, "box_strain", &[strain]);
                put(&mut simulation, "box_corner_low", &[left[0], left[1], left[2], 0.0]);
                put(&mut simulation, "box_watch", &[side, 0.25, 1.5, 20.0 * side]);
                let change = chosen(&step, |kernel| kernel.name.starts_with("box"));
                stages.push(Stage::of("box", simulation, change).slack(4.0));
            }
            // Particles that are a little beyond the far side are at the near one.
            let (mut simulation, step, _) = make(1);
            let world = pollster::block_on(simulation.backend().world()).expect("a world");
            let mut places = pollster::block_on(simulation.read(POSITION)).expect("places");
            for (axis, place) in places.iter_mut().take(9).enumerate() {
                let axis = axis % if flat { 2 } else { 3 };
                place[axis] = 1.000_01 * world.bounds.high.as_vec3()[axis].abs();
            }
            simulation.write(POSITION, &places).expect("places");
            put(&mut simulation, "box_strain", &[0.031_25]);
            let change = chosen(&step, |kernel| kernel.name.starts_with("box"));
            stages.push(Stage::of("beyond the box", simulation, change).slack(4.0));
            // All kernels know the box again where a run goes on.
            let (mut simulation, _, time) = make(1);
            let world = pollster::block_on(simulation.backend().world()).expect("a world");
            let high = world.bounds.high + if flat { DVec3::new(1.0, 2.0, 0.0) } else { DVec3::new(1.0, 2.0, 3.0) };
            simulation
                .backend()
                .set_world(World { bounds: Bounds { high, ..world.bounds }, ..world })
                .expect("a world");
            let set = chosen(&time, |kernel| kernel.name.starts_with("box"));
            stages.push(Stage::of("box at the start", simulation, set));
        }
    }
}
