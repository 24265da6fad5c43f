//! What a periodic world does, by the references and on a device.

use std::f64::consts::PI;

use glam::{DVec3, DVec4, Vec4};
use motes::forces::Component;
use motes::integrators::Step;
use motes::kernel::{Backend, Machine};
use motes::lockstep::compare;
use motes::settings::Value;
use motes::{ACCELERATION, Bounds, POSITION, Setup, Simulation, State};

use crate::ewald::{MOST, cube, exact_sum, gravity, scattered};
use crate::support::machines::{self, gpu, machines};
use crate::support::states::{accelerations_in, cpu_in, force, integrator, phase, word};
use crate::support::{self, Shared};

fn lattice(side: f64, number: u8) -> State {
    let mut lattice = State::default();
    let n = f64::from(number);
    for x in 0..number {
        for y in 0..number {
            for z in 0..number {
                let place = DVec3::new(f64::from(x), f64::from(y), f64::from(z)) + 0.5;
                lattice.push(cube(side).low + place * side / n, DVec3::ZERO, 1.0 / n.powi(3), 0.0);
            }
        }
    }
    lattice
}

pub const SIDE: f64 = 3.5;
pub const G: f64 = 0.8;

/// In a lattice no direction is preferred; and the energy of each particle is that of a mass alone in a smaller cube.
#[test]
fn a_lattice_has_no_acceleration() {
    let side = 2.0;
    for number in [2, 5] {
        let lattice = lattice(side, number);
        let got = accelerations_in(&cube(side), &gravity(1.0, 0.0, "pairs"), &lattice, 0.0);
        let n = f64::from(number);
        let want = 0.5 * crate::ewald::exact::alone(crate::ewald::SPLITTING) * n / side / n.powi(3);
        for a in &got {
            // Sums of up to 250 terms of up to 25 / 4 / 125.
            assert!(a.truncate().length() < 1e-13, "{a}");
            assert!((a.w - want).abs() < 2e-5 / side, "{} is not {want}", a.w);
        }
    }
}

/// A plane wave in a cold uniform world at rest grows as cosh(ω t), ω² = 4π G ρ, whatever its length (Jeans 1902, without
/// pressure). Sheets would do just that; sheets made of a square lattice of points, a apart, which stand behind each other, pull
/// beyond that by the potential −(2π G σ / q) Σ exp(−q z) of the waves q along the sheets, of which there are four of 2π / a
/// and four of √2 times that. Only the next sheets count:
/// ω² = 4π G ρ [1 + (4π exp(−2π) + √2 4π exp(−√2 2π)) (2 − 2 cos k a)].
#[test]
fn a_plane_wave_grows_as_jeans_says() {
    let (side, number, g) = (1.0, 8, 1.0 / (4.0 * PI));
    let mut wave = lattice(side, number);
    let shape = |x: f64| (2.0 * PI * x / side).sin();
    let start: Vec<f64> = wave.position().iter().map(|x| x.x).collect();
    let small = 1e-3;
    for x in wave.position_mut() {
        x.x += small * shape(x.x - cube(side).low.x);
    }
    // ω is 1 here: two times e.
    let dt = 0.05;
    let mut simulation = cpu_in(&cube(side), &wave, gravity(g, 0.0, "pairs"), "leapfrog", dt);
    simulation.step(40).expect("steps");
    let places = phase(&mut simulation).0;
    let low = cube(side).low.x;
    let overlap: f64 = places.iter().zip(&start).map(|(x, q)| (x.x - q) * shape(q - low)).sum();
    let norm: f64 = start.iter().map(|q| shape(q - low).powi(2)).sum();
    let growth = overlap / norm / small;
    let next = [1.0, 2.0_f64.sqrt()].map(|q| q * 4.0 * PI * (-2.0 * PI * q).exp()).iter().sum::<f64>();
    let rate = (1.0 + next * (2.0 - 2.0 * (2.0 * PI / f64::from(number)).cos())).sqrt();
    let want = (2.0 * rate).cosh();
    // Steps of leapfrog: (ω dt)² / 24 of ω t, 2e-4; the waves that are left out, 1e-4; an amplitude that ends as 4e-3 of the side.
    assert!((growth / want - 1.0).abs() < 1e-3, "it grows to {growth}, not {want}");
    let across = places.iter().zip(wave.position()).map(|(x, q)| (x.y - q.y).abs().max((x.z - q.z).abs()));
    assert!(across.fold(0.0, f64::max) < 1e-9, "it turns");
}

/// A cloud by a law on a device, every kernel of which must agree with its reference.
pub fn on_device(
    shared: &Shared,
    machine: Option<Machine>,
    count: usize,
    forces: Vec<Box<dyn Component>>,
) -> (State, Vec<DVec4>) {
    let bounds = cube(SIDE);
    let cloud = scattered(count, &bounds, 4);
    let mut gpu = gpu(shared, count);
    let machine = machine.unwrap_or(gpu.machine());
    gpu.pretend(machine);
    let setup = Setup {
        state: cloud.clone(),
        forces,
        integrator: integrator("symplectic_euler"),
        dt: 0.01,
        bounds,
        solver: motes::Solver::default(),
    };
    let mut simulation = Simulation::on(gpu, &setup).expect("a simulation");
    let number = simulation.count();
    let problem = motes::forces::Problem::new(number, machine).at(cloud.position(), bounds);
    let mut step = Step::new(&setup.forces, problem);
    step.evaluate();
    let plan = step.finished().expect("a plan");
    let places: Vec<_> = cloud.position().iter().zip(cloud.mass()).map(|(x, m)| x.extend(*m).as_vec4()).collect();
    simulation.write(POSITION, &places).expect("places");
    let verdicts = pollster::block_on(compare(simulation.backend(), &plan, number)).expect("verdicts");
    for v in &verdicts {
        // A single particle is pulled by its own waves, which cancel: what is left is rounding.
        assert!(if count > 1 { v.good() } else { v.sound() }, "{count}: {v:?}");
    }
    let got = pollster::block_on(simulation.read(ACCELERATION)).expect("accelerations");
    (cloud, got.into_iter().map(Vec4::as_dvec4).collect())
}

#[test]
fn a_device_sums_as_exactly() {
    let shared = support::device();
    for count in [1, 2, 65] {
        let want = exact_sum(&scattered(count, &cube(SIDE), 4), SIDE, G);
        for (name, machine) in machines(&shared) {
            let (cloud, got) = on_device(&shared, Some(machine), count, gravity(G, 0.0, "pairs"));
            let mass: f64 = cloud.mass().iter().sum();
            for (got, want) in got.iter().zip(&want) {
                let error = *got - *want;
                // The waves that are left out; and of a force that is larger than that of all, rounding.
                let allowed = MOST * G * mass / (SIDE * SIDE) + 1e-5 * want.truncate().length();
                assert!(error.truncate().length() < allowed, "{name}, {count}: {got} is not {want}");
                let allowed = 2e-5 * G * mass / SIDE + 1e-5 * want.w.abs();
                assert!(error.w.abs() < allowed, "{name}, {count}: {got} is not {want}");
            }
        }
    }
    // Several particles to a block of the structure factor.
    on_device(&shared, None, 1500, gravity(G, 0.0, "pairs"));
}

/// Far groups as one, on the device and by the reference.
#[test]
fn a_tree_sums_as_exactly() {
    let shared = support::device();
    if machines::subgroups_of_eight(&shared) {
        on_device(&shared, None, 1500, gravity(G, 0.0, "tree"));
    }
}

/// The force between two fades out before the nearest image changes, so that far groups of it are evaluated as in open space: the
/// error of a force is the same part of what a neighbour does, wherever the box ends. What the forces of all add up to is
/// less there than in open space, where all pull towards the middle.
#[test]
fn far_groups_are_met_as_in_open_space() {
    let count = 1000;
    let cloud = scattered(count, &cube(1.0), 4);
    let error = |bounds: &Bounds, images: &'static str| {
        let accelerations = |over: &'static str| {
            let settings = [("softening", Value::Number(0.01)), ("over", word(over)), ("images", word(images))];
            accelerations_in(bounds, &[force("gravity", &settings)], &cloud, 0.0)
        };
        let mut errors: Vec<f64> = accelerations("tree")
            .iter()
            .zip(accelerations("pairs"))
            .map(|(a, b)| (*a - b).truncate().length())
            .collect();
        errors.sort_by(f64::total_cmp);
        [errors[count / 2], errors[count * 99 / 100]]
    };
    let (open, closed) = (error(&Bounds::default(), "nearest"), error(&cube(1.0), "ewald"));
    for (open, closed) in open.into_iter().zip(closed) {
        assert!(closed > 0.0 && closed < 1.5 * open, "{closed:e} in the box, {open:e} outside");
    }
}
