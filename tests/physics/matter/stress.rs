//! `stress`: the forces of contacts are those that accelerate grains, with the history of their sliding.

use std::sync::Arc;

use glam::{DMat3, DVec3};
use motes::kernel::Array;
use motes::measure::{Cell, Moment, Row, measure};
use motes::motion::{Keyframe, Motion};
use motes::settings::{Settings, Value};
use motes::{Bounds, Setup, State};
use pollster::block_on;

use super::grains::{GRAIN, Grain, state};
use super::{on_cpu, setup};
use crate::support::Random;
use crate::support::states::{force, vector};

/// The rows of the measure for a state of a setup.
fn stress(setup: &Setup, state: &State, sets: &[(&'static str, Value)]) -> Vec<Row> {
    let measure = measure("stress").expect("a measure");
    let defaults = Settings::defaults(measure.keys);
    let settings = sets.iter().fold(defaults, |all, (key, value)| all.with(key, value.clone()));
    let mut series = (measure.begin)(setup, &settings).expect("a series");
    let state = Arc::new(state.clone());
    let moment = Moment { state: &state, density: &[], clock: None, links: None, virial: None };
    series.take(&moment).expect("rows")
}

fn number(row: &Row, cell: usize) -> f64 {
    if let Cell::Number(x) = row[cell] { x } else { f64::NAN }
}

/// −Σ f ⊗ l over contacts, in a region of unit volume: rows are those of the force.
fn contacts(row: &Row) -> [DVec3; 3] {
    [0, 1, 2].map(|along| DVec3::from_array([0, 1, 2].map(|across| number(row, 5 + 3 * along + across))))
}

/// A region of unit volume around everything.
fn around() -> [(&'static str, Value); 2] {
    [("low", vector(-4.0, -4.0, -4.0)), ("high", vector(4.0, 4.0, 4.0))]
}

fn accelerations(simulation: &mut motes::Simulation<motes::Cpu>) -> Vec<DVec3> {
    let Some(Array::Vec4(all)) = simulation.backend().host().get("acceleration") else { panic!("accelerations") };
    all.iter().map(|a| a.truncate()).collect()
}

/// Without dashpots: forces are those of springs, which do not depend on the half step.
fn springs(more: &[(&'static str, Value)]) -> Vec<(&'static str, Value)> {
    let given = [
        ("restitution", 1.0.into()),
        ("tangential_damping", 0.0.into()),
        ("stiffness", 5e3.into()),
        ("young_modulus", 1e4.into()),
    ];
    given.into_iter().chain(more.iter().cloned()).collect()
}

/// Twenty-seven grains of different sizes that collide and rub: V σ = Σ x ⊗ m a, which follows from f of each contact, as −Σ f ⊗ l does. Half of
/// them slide at their limit. Negative control: with the history forgotten it is off by a percent and more.
#[test]
fn contacts_have_the_forces_that_accelerate_grains() {
    for (seed, model) in [(5, "linear"), (6, "hertz")] {
        let mut random = Random::new(seed);
        let mut grain = |i: usize| Grain {
            position: 0.93 * DVec3::new((i % 3) as f64, (i / 3 % 3) as f64, (i / 9) as f64) + 0.05 * random.vector(),
            velocity: 0.3 * random.vector(),
            spin: 2.0 * random.vector(),
            mass: 1.0 + 0.5 * random.next(),
            radius: 0.45 + 0.04 * random.next(),
            ..GRAIN
        };
        let all: Vec<Grain> = (0..27).map(&mut grain).collect();
        let more = springs(&[("range", 1.0.into()), ("friction", 0.3.into()), ("model", Value::Text(model.into()))]);
        let all = setup(state(&all), vec![force("contact", &more)], Bounds::default(), 1e-3);
        let mut simulation = on_cpu(&all);
        simulation.step(40).expect("steps");
        // Those of the last evaluation.
        let a = accelerations(&mut simulation);
        let now = block_on(simulation.snapshot()).expect("a state");
        // Kinetic parts are of the masses alone.
        let still = |state: &State| {
            let row = &stress(&all, state, &around())[0];
            let rows = contacts(row).map(|row| 512.0 * row);
            let carried = kinetic(state);
            [0, 1, 2].map(|k| rows[k] - carried.row(k))
        };
        let got = still(&now);
        let want: [DVec3; 3] = std::array::from_fn(|along| {
            (0..27).map(|i| now.mass()[i] * a[i][along] * now.position()[i]).sum::<DVec3>()
        });
        let size: f64 = want.iter().map(|row| row.length()).fold(0.0, f64::max);
        let off = |got: &[DVec3; 3]| got.iter().zip(&want).map(|(a, b)| (*a - *b).length()).fold(0.0, f64::max) / size;
        let forgot = still(&now.clone().begin_anew());
        println!("{model}: {size} {:e} {:e}", off(&got), off(&forgot));
        // States hold what the device does in single precision.
        assert!(size > 1.0 && off(&got) < 1e-6 && off(&forgot) > 0.01, "{got:?} is not {want:?}");
    }
}

/// Σ m v ⊗ v relative to the mean velocity.
fn kinetic(state: &State) -> DMat3 {
    let pairs = || state.velocity().iter().zip(state.mass());
    let mean = pairs().map(|(v, m)| *m * *v).sum::<DVec3>() / state.mass().iter().sum::<f64>();
    let of = |(v, m): (&DVec3, &f64)| {
        let v = *v - mean;
        DMat3::from_cols(*m * v * v.x, *m * v * v.y, *m * v * v.z)
    };
    pairs().map(of).fold(DMat3::ZERO, |sum, one| sum + one)
}

/// A grain on a floor that moves along, and one in the corner of a box: −f ⊗ l with l from the centre to the contact.
#[test]
fn walls_push_as_they_accelerate_grains() {
    let belt = Motion {
        name: "belt".to_owned(),
        about: DVec3::ZERO,
        keys: [0.0, 10.0].map(|time| Keyframe { time, shift: DVec3::X * time, turn: DVec3::ZERO }).to_vec(),
        smooth: false,
        repeat: false,
    };
    let word = |text: &'static str| Value::Text(text.into());
    let floor = vec![("motion", word("belt")), ("friction", 0.4.into())];
    let corner = vec![("shape", word("box")), ("size", vector(3.0, 3.0, 3.0)), ("inside", Value::Flag(true))];
    let deep = 0.48;
    for (more, position, walls) in [
        (floor, DVec3::new(0.3, -0.2, deep), vec![-DVec3::Z]),
        (corner, DVec3::splat(1.5 - deep), vec![DVec3::X, DVec3::Y, DVec3::Z]),
    ] {
        let grain = Grain { position, velocity: DVec3::new(0.05, 0.1, -0.02), ..GRAIN };
        let mut all = setup(state(&[grain]), vec![force("contact_wall", &springs(&more))], Bounds::default(), 1e-3);
        all.state.motions = vec![belt.clone()];
        let mut simulation = on_cpu(&all);
        simulation.step(7).expect("steps");
        let a = accelerations(&mut simulation)[0];
        let now = block_on(simulation.snapshot()).expect("a state");
        let rows = contacts(&stress(&all, &now, &around())[0]).map(|row| 512.0 * row);
        let arm = |n: &DVec3| {
            let distance = if walls.len() > 1 { 1.5 - now.position()[0].dot(*n) } else { now.position()[0].z };
            0.5 * (0.5 + distance)
        };
        // Sideways forces on the three walls of a corner add up in the acceleration: only their sum is known.
        for along in 0..3 {
            let got: f64 = walls.iter().map(|n| rows[along].dot(*n) / arm(n)).sum();
            assert!((got + a[along]).abs() < 1e-5 * a.length(), "{walls:?}: {got} is not {}", -a[along]);
        }
        assert!(a.dot(walls[0]) < -10.0 && a.x.abs() > 0.5, "{a}");
    }
}
