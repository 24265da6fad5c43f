//! Stages of grains that touch each other and walls, dry and wet.
#![allow(clippy::cast_possible_truncation, reason = "numbers are rounded to what f32 holds")]

use glam::{DVec3, Vec4};
use motes::forces::Component;
use motes::kernel::{Array, Backend, POSITION, VELOCITY};
use motes::settings::Value;
use motes::{Bounds, Gpu, Setup, Side, Simulation, Solver};

use crate::matter::{few, number};
use crate::stages::{Device, FEW, Stage};
use crate::support::equivalents::{Equivalent, same};
use crate::support::machines::alone;
use crate::support::states::{force, integrator};
use crate::support::{self, Random, choices};

const ALWAYS_SET: &str = "the host sets every override";
const BRIDGE: &str = "shaders/grains/bridge.wgsl";
const TOUCH: &str = "shaders/grains/touch.wgsl";
const EDGE: &str = "no pair lies exactly at the edge";

pub const EQUIVALENT: &[Equivalent] = &[
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
    same("bridge.wgsl", "let touches = at.overlap > 0.0;", ">", ">=", EDGE),
    same("bridge.wgsl", "if pair.pull > 0.0", ">", ">=", "a pull of 0 has no energy, and its word is not kept"),
    same("bridge.wgsl", "let holds =", "<", "<=", EDGE),
    same("contact.wgsl", "let meets = may_touch", "<", "<=", EDGE),
    same("contact_wall.wgsl", "may_touch(overlap, mine.w) ||", "<", "<=", EDGE),
    same("touch.wgsl", "if sprung && pair.rolling > 0.0", ">", ">=", "a spring without stiffness gives no torque")
        .sometimes(),
    same("touch.wgsl", "if pair.torsion > 0.0", ">", ">=", "a spring without stiffness gives no torque").sometimes(),
    same("touch.wgsl", "var twist = 0.0", "0.0", "1.0", "without torsion its word is not read").sometimes(),
    same("touch.wgsl", "if most > rolling_limit", ">", ">=", "at the limit it is the limit either way"),
];

/// Angular velocities and radii.
const SPINS: motes::kernel::Field<Vec4> = motes::kernel::Field::new("angular_velocity");

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
    // Dry; wet, with bridges since five steps, which break 0.18 radii apart; and wet by less, with weaker ones that form now.
    let wet = [(linear(0.4, 0.3), 4.0, 0.004, 5), (rolling[0], 4.0, 0.004, 5), (rolling[3], 0.12, 1e-5, 0)];
    let dry = some.into_iter().chain(rolling).map(|one| (one, 0.0, 0.004, 5));
    for ((friction, spring, model, rolling_model, [rolling, torsion]), tension, volume, steps) in dry.chain(wet) {
        let settings = [
            ("surface_tension", number(tension)),
            ("contact_angle", number(0.3)),
            ("bridge_volume", number(volume)),
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
        simulation.step(steps).expect("steps");
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
            let rupture = 1.15 * f64::cbrt(volume) * radius(i).min(radius(i + 1));
            let gap = match (k % 4, tension > 0.0) {
                (2, true) => 0.8 * rupture,
                (3, true) => 1.1 * rupture,
                (0 | 2, _) => 1e-3,
                _ => 1.25 / 16.0 * reduced,
            };
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
        let stage = Stage::of("grains", simulation, alone(kernel)).slack(8.0);
        stages.push(if tension > 0.0 { stage } else { stage.overlooking(BRIDGE) });
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
    let wet = [
        ("surface_tension", number(4.0)),
        ("contact_angle", number(0.3)),
        ("bridge_volume", number(0.004)),
        ("torsional_friction", number(0.2)),
    ];
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
        ([&plane[..], &wet].concat(), open),
        ([&container[..], &wet, &swing].concat(), open),
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
            let is_wet = more.iter().any(|(key, _)| *key == "surface_tension");
            for steps in if is_wet { &[3, 0][..] } else { &[3] } {
                let mut simulation = simulation_at(device, &setup, *steps);
                if more.starts_with(&plane) && bounds == open {
                    // Wet ones stretch bridges, and break them.
                    let heights = if is_wet { [1.03, 1.15, 1.25] } else { [1.03; 3] };
                    lifted(&mut simulation, DVec3::new(0.3, -0.2, 0.9).normalize(), radius, heights);
                }
                // What is dissipated is the difference of the power of forces and of what springs gain.
                let stage = Stage::of("wall", simulation, alone(kernel.clone())).slack(30.0);
                // Dry walls show nothing of bridges, and all of a contact.
                stages.push(stage.overlooking(if is_wet { TOUCH } else { BRIDGE }));
            }
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

/// Lifts some grains that touch a plane off it to these heights in radii: by less than a sixteenth their contacts have just ended.
fn lifted(simulation: &mut Simulation<Gpu>, normal: DVec3, radius: impl Fn(usize) -> f64, heights: [f64; 3]) {
    let mut places = pollster::block_on(simulation.read(POSITION)).expect("places");
    let mut count = 0;
    for (i, place) in places.iter_mut().enumerate().take(FEW) {
        let above = (place.truncate().as_dvec3() - DVec3::new(0.125, -0.25, 0.25)).dot(normal);
        if i % 3 == 0 && above < 0.9 * radius(i) {
            let x = place.truncate().as_dvec3() + (heights[i / 3 % 3] * radius(i) - above) * normal;
            *place = x.as_vec3().extend(place.w);
            count += 1;
        }
    }
    assert!(count > 10, "{count} contacts have ended");
    simulation.backend().write_bytes(POSITION.name, 0, bytemuck::cast_slice(&places)).expect("places");
}

/// All of them; `large` has as many workgroups as a list of neighbours has layers.
pub fn all(large: &Device, device: &Device, stages: &mut Vec<Stage>) {
    grains(large, stages);
    walls(device, stages);
}
