//! Stages of barostats: what they measure, the change that follows, and the box as it changes with its particles.

use glam::DVec3;
use motes::forces::Component;
use motes::kernel::{Backend, Kernel, Plan, World};
use motes::settings::Value::Number;
use motes::{Bounds, Gpu, Setup, Side, Simulation, Solver};

use crate::stages::{Device, FEW, Stage};
use crate::support::Random;
use crate::support::equivalents::{Equivalent, same};
use crate::support::states::{force, integrator, word};

const ALWAYS_SET: &str = "the host sets every override";

pub const EQUIVALENT: &[Equivalent] = &[
    same("barostat/due.wgsl", "override EVERY: u32 = 1u;", "1u", "2u", ALWAYS_SET),
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
    let low = DVec3::new(-1.25, 2.5, if flat { 0.0 } else { -3.75 });
    let mut state = motes::State::default();
    for i in 0..FEW {
        let (x, v) = (0.5 + 0.5 * random.vector(), random.vector());
        let place = (low + sides * x).as_vec3().as_dvec3();
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
            // Larger and smaller, and as before.
            for (strain, side) in [(0.046_875, 9.0), (-0.046_875, 9.75), (0.0, 0.0), (1.5e-6, 0.0)] {
                let (mut simulation, step, _) = make(1);
                put(&mut simulation, "box_strain", &[strain]);
                put(&mut simulation, "box_watch", &[side, 0.25, 1.5, 0.0]);
                let change = chosen(&step, |kernel| kernel.name.starts_with("box"));
                stages.push(Stage::of("box", simulation, change).slack(4.0));
            }
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
