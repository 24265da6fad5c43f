//! Measures: what they give of states that are known, and what they refuse.

#![allow(clippy::float_cmp, reason = "whole numbers and halves are exact")]

use std::collections::BTreeSet;
use std::sync::Arc;

use glam::DVec3;
use motes::kernel::Array;
use motes::measure::{Cell, MEASURES, Moment, Row, measure};
use motes::settings::{Settings, Value};
use motes::{Bounds, Error, Setup, Side, State};

use crate::support::Random;
use crate::support::states::{force, word};

pub fn setup(state: &State, bounds: Bounds) -> Setup {
    Setup {
        state: state.clone(),
        forces: Vec::new(),
        integrator: motes::integrators::INTEGRATORS[0].by_default(),
        dt: 0.1,
        bounds,
        solver: motes::Solver::default(),
    }
}

/// A virial.
const VIRIAL: [f64; 6] = [0.5, 0.25, -2.0, 4.0, -0.125, 1.0];

/// The rows of a measure of a state, whose potential energies are 0.
pub fn rows(name: &str, state: &State, bounds: Bounds, sets: &[(&'static str, Value)]) -> Result<Vec<Row>, Error> {
    let measure = measure(name).expect("a measure");
    let defaults = Settings::defaults(measure.keys);
    let settings = sets.iter().fold(defaults, |all, (key, value)| all.with(key, value.clone()));
    let mut state = state.clone();
    let potential = motes::Column::new("potential", motes::Kind::Scalar, "", "").derived();
    state.declare(&potential).expect("a column");
    state.set("potential", Array::Float(vec![0.0; state.len()])).expect("a column");
    let mut setup = setup(&state, bounds);
    // Corrections are those of a law.
    if name == "tail" {
        setup.forces.push(force("lennard_jones", &[("range", Value::Number(1.0)), ("truncation", word("cut"))]));
    }
    // And scale factors those of gravity where space expands.
    if name == "expansion" {
        setup.forces.push(force("gravity", &[("hubble", Value::Number(0.7)), ("images", word("ewald"))]));
    }
    // Stresses are those of contacts.
    if name == "stress" {
        setup.forces.push(force("contact", &[("range", Value::Number(1.0))]));
    }
    let mut series = (measure.begin)(&setup, &settings)?;
    let moment = Moment { state: &Arc::new(state), density: &[], clock: None, links: None, virial: Some(VIRIAL) };
    series.take(&moment)
}

pub fn numbers(rows: &[Row], cell: usize) -> Vec<f64> {
    let number = |row: &Row| match row[cell] {
        Cell::Number(x) => x,
        Cell::Whole(n) => n as f64,
        _ => f64::NAN,
    };
    rows.iter().map(number).collect()
}

pub fn periodic(size: DVec3) -> Bounds {
    Bounds::new(DVec3::ZERO, size, Side::Periodic)
}

/// A face-centred cubic crystal of four particles to a cell of unit size, in species 0 and 1 by layers.
pub fn crystal(cells: usize) -> State {
    let mut state = State::default();
    let basis = [[0.0, 0.0, 0.0], [0.5, 0.5, 0.0], [0.5, 0.0, 0.5], [0.0, 0.5, 0.5]];
    for k in 0..cells.pow(3) {
        let cell = [k % cells, k / cells % cells, k / cells / cells].map(|n| n as f64 + 0.1);
        for b in basis {
            state.push(DVec3::from(cell) + DVec3::from(b), DVec3::ZERO, 1.0, 0.0);
        }
    }
    state
}

#[test]
fn tables_have_names_of_their_own_and_rows_as_long_as_their_headers() {
    let names: BTreeSet<_> = MEASURES.iter().map(|measure| measure.name).collect();
    assert_eq!(names.len(), MEASURES.len());
    let (mut state, bounds) = (crystal(3), periodic(DVec3::splat(3.0)));
    let unwrapped = motes::Column::new("unwrapped", motes::Kind::Vector, "length", "").with_rate("velocity");
    state.declare(&unwrapped).expect("a column");
    state.set("unwrapped", Array::Vec3(vec![DVec3::ZERO; state.len()])).expect("a column");
    let radius = motes::Column::new("radius", motes::Kind::Scalar, "length", "");
    state.declare(&radius).expect("a column");
    state.set("radius", Array::Float(vec![0.1; state.len()])).expect("a column");
    let range = [
        ("range", Value::Number(0.9)),
        ("largest", Value::Number(9.0)),
        ("start", Value::Vector(DVec3::ZERO)),
        ("linking_distance", Value::Number(0.9)),
    ];
    for measure in MEASURES.iter().filter(|measure| measure.name != "fluid") {
        let sets: Vec<_> =
            range.iter().filter(|(key, _)| measure.keys.iter().any(|k| k.name == *key)).cloned().collect();
        let rows = rows(measure.name, &state, bounds, &sets).unwrap_or_else(|why| panic!("{}: {why}", measure.name));
        let cells: BTreeSet<_> = measure.cells.iter().map(|(name, _)| name).collect();
        assert_eq!(cells.len(), measure.cells.len(), "{}", measure.name);
        assert_eq!(measure.header().split(',').count(), 2 + measure.cells.len());
        assert!(
            !rows.is_empty() && rows.iter().all(|row| row.len() == measure.cells.len()),
            "{}: {rows:?}",
            measure.name
        );
    }
}

/// Shells of the crystal: 12 at 1/√2, 6 at 1, 24 at √(3/2) (Kittel).
#[test]
fn a_crystal_has_its_shells() {
    let (state, bounds) = (crystal(4), periodic(DVec3::splat(4.0)));
    let sets = [("range", Value::Number(1.3)), ("bins", Value::Number(130.0))];
    let rows = rows("rdf", &state, bounds, &sets).expect("rows");
    let (r, g, within) = (numbers(&rows, 0), numbers(&rows, 1), numbers(&rows, 2));
    assert_eq!(rows.len(), 130);
    for (k, r) in r.iter().enumerate() {
        assert!((r - 0.01 * (k as f64 + 0.5)).abs() < 1e-12);
        let shells = [(0.5_f64.sqrt(), 12.0), (1.0, 6.0), (1.5_f64.sqrt(), 24.0)];
        let end = r + 0.005;
        // Particles stand on a lattice of binary fractions plus 0.1: distances are off by some roundings of these.
        let near = shells.iter().any(|(shell, _)| (shell - end).abs() < 1e-9);
        let want: f64 = shells.iter().filter(|(shell, _)| *shell < end).map(|(_, n)| n).sum();
        assert!(near || (within[k] - want).abs() < 1e-9, "{} within {end}, and not {want}", within[k]);
        let has = shells.iter().any(|(shell, _)| (shell - r).abs() < 0.005);
        assert!((g[k] > 0.0) == has || near || g[k - 1] > 0.0, "g({r}) = {}", g[k]);
    }
    // 12 of 255 others in 64 cells of volume 1, in a shell from 0.70 to 0.71.
    let shell = 4.0 / 3.0 * std::f64::consts::PI * (0.71_f64.powi(3) - 0.7_f64.powi(3));
    assert!((g[70] - 12.0 / (255.0 / 64.0 * shell)).abs() < 1e-9 * g[70], "{}", g[70]);
}

/// A gas without forces has g = 1: each bin counts some n pairs, twice each, and is off by about 1 / √n.
#[test]
fn a_gas_has_none() {
    for (seed, flat) in [(3, false), (7, false), (11, true)] {
        let size = DVec3::new(3.0, 2.0, if flat { 0.0 } else { 2.5 });
        let mut bounds = periodic(size);
        if flat {
            (bounds.dimensions, bounds.sides[2]) = (2, Side::Open);
        }
        let (mut random, mut state) = (Random::new(seed), State::default());
        for _ in 0..6000 {
            let x = DVec3::new(random.next(), random.next(), random.next());
            state.push(x * size, DVec3::ZERO, 1.0, 0.0);
        }
        let sets = [("range", Value::Number(1.0)), ("bins", Value::Number(10.0))];
        let rows = rows("rdf", &state, bounds, &sets).expect("rows");
        let (r, g) = (numbers(&rows, 0), numbers(&rows, 1));
        for (r, g) in r.iter().zip(g) {
            let volume =
                if flat { 2.0 * std::f64::consts::PI * r * 0.1 } else { 4.0 * std::f64::consts::PI * r * r * 0.1 };
            let whole = if flat { 6.0 } else { 15.0 };
            let pairs = 0.5 * 6000.0 * 6000.0 * volume / whole;
            // Five deviations.
            assert!((g - 1.0).abs() < 5.0 / pairs.sqrt() + 1e-3, "seed {seed}: g({r}) = {g}, of {pairs:.0} pairs");
        }
    }
}

/// Of two species in alternate places each has the other around it.
#[test]
fn species_are_apart() {
    let mut state = State::default();
    for k in 0..64_u32 {
        let x = [k % 4, k / 4 % 4, k / 16];
        state.push(DVec3::from(x.map(f64::from)) + 0.25, DVec3::ZERO, 1.0, 0.0);
        let last = state.len() - 1;
        state.species_mut()[last] = x.iter().sum::<u32>() % 2;
    }
    let count = |species: f64, others: Option<f64>| {
        let others = others.map(|kind| ("others", Value::Number(kind)));
        let sets: Vec<_> =
            [("range", Value::Number(1.2)), ("bins", Value::Number(1.0)), ("species", Value::Number(species))]
                .into_iter()
                .chain(others)
                .collect();
        numbers(&rows("rdf", &state, periodic(DVec3::splat(4.0)), &sets).expect("rows"), 2)[0]
    };
    assert_eq!(
        [count(0.0, Some(0.0)), count(0.0, Some(1.0)), count(1.0, Some(0.0)), count(0.0, None)],
        [0.0, 6.0, 6.0, 6.0]
    );
    // All are around those of one species; a crystal has no more around one than there are.
    let sets = [("range", Value::Number(2.0)), ("bins", Value::Number(1.0)), ("species", Value::Number(1.0))];
    let all = rows("rdf", &state, periodic(DVec3::splat(4.0)), &sets).expect("rows");
    let [g, within] = [1, 2].map(|cell| numbers(&all, cell)[0]);
    let ball = 4.0 / 3.0 * std::f64::consts::PI * 8.0;
    assert!((g - within / (63.0 * ball / 64.0)).abs() < 1e-12, "{g}");
}

#[test]
fn temperature_is_the_mean_kinetic_energy() {
    let mut state = State::default();
    for (v, mass) in
        [(DVec3::new(1.0, 2.0, -1.0), 1.0), (DVec3::new(3.0, 0.0, 1.0), 3.0), (DVec3::new(9.0, 9.0, 9.0), 5.0)]
    {
        state.push(DVec3::ZERO, v, mass, 0.0);
    }
    // The last one is fixed.
    state.held.push(motes::motion::Held { id: 2, by: motes::motion::Hold::Fixed });
    let open = Bounds::default();
    let of = |sets: &[(&'static str, Value)]| {
        let rows = rows("thermo", &state, open, sets).expect("rows");
        [0, 1, 2].map(|cell| numbers(&rows, cell)[0])
    };
    // Relative to the centre of mass, (2.5, 0.5, 0.5): ½ (1·(2.25 + 2.25 + 2.25) + 3·(0.25 + 0.25 + 0.25)) = 4.5, of three degrees of freedom.
    assert_eq!(of(&[]), [2.0, 2.0 * 4.5 / 3.0, 2.25]);
    assert_eq!(of(&[("boltzmann", Value::Number(0.5))])[1], 6.0);
    // ½ (6 + 30) = 18, of six.
    assert_eq!(of(&[("drift", Value::Flag(true))]), [2.0, 6.0, 9.0]);
}

/// (Σ m v ⊗ v + W) / V, relative to the centre of mass.
#[test]
fn pressure_has_a_kinetic_part_and_a_virial() {
    let mut state = State::default();
    for (v, mass) in
        [(DVec3::new(1.0, 2.0, -1.0), 1.0), (DVec3::new(3.0, 0.0, 1.0), 3.0), (DVec3::new(9.0, 9.0, 9.0), 5.0)]
    {
        state.push(DVec3::ONE, v, mass, 0.0);
    }
    state.held.push(motes::motion::Held { id: 2, by: motes::motion::Hold::Fixed });
    let of = |state: &State, bounds: Bounds| {
        rows("pressure", state, bounds, &[]).map(|rows| (0..8).map(|cell| numbers(&rows, cell)[0]).collect::<Vec<_>>())
    };
    // Velocities are (−1.5, 1.5, −1.5) and (0.5, −0.5, 0.5) there: 3 along each axis, with signs. The volume is 32.
    let parts = [3.5, 3.25, 1.0, 1.0, 2.875, -2.0].map(|part| part / 32.0);
    let want = [&[7.75 / 96.0, 3.0 / 32.0], &parts[..]].concat();
    assert_eq!(of(&state, periodic(DVec3::new(2.0, 4.0, 4.0))).expect("rows"), want);
    assert!(of(&state, Bounds::default()).is_err_and(|why| why.to_string().contains("this box is open")));
    // In the plane there is an area, and two axes.
    let flat = Bounds { dimensions: 2, ..Bounds::new(DVec3::ZERO, DVec3::new(2.0, 4.0, 0.0), Side::Reflecting) };
    state.position_mut().iter_mut().for_each(|x| x.z = 0.0);
    state.velocity_mut().iter_mut().for_each(|v| v.z = 0.0);
    let rows = of(&state, flat).expect("rows");
    assert_eq!(rows[..4], [6.75 / 16.0, 3.0 / 8.0, 3.5 / 8.0, 3.25 / 8.0]);
}

/// Velocities that grow along y, on a lattice: a probe amid eight particles has their mean.
#[test]
fn a_probe_has_density_and_velocity() {
    let mut state = State::default();
    for k in 0..1000_u32 {
        let x = DVec3::from([k % 10, k / 10 % 10, k / 100].map(|n| 0.1 * f64::from(n)));
        state.push(x, DVec3::new(2.0 * x.y, -1.0, 0.0), 0.001, 0.0);
    }
    let sets = [
        ("start", Value::Vector(DVec3::new(0.45, 0.25, 0.45))),
        ("span", Value::Vector(DVec3::new(0.0, 0.4, 0.0))),
        ("count", Value::Number(5.0)),
        ("range", Value::Number(0.25)),
    ];
    let found = rows("probe", &state, periodic(DVec3::ONE), &sets).expect("rows");
    assert_eq!(found.len(), 5);
    for (k, row) in found.iter().enumerate() {
        let [_, y, _, particles, density, vx, vy, vz] =
            [0, 1, 2, 3, 4, 5, 6, 7].map(|cell| numbers(std::slice::from_ref(row), cell)[0]);
        assert!((y - (0.25 + 0.1 * k as f64)).abs() < 1e-12 && particles > 50.0);
        // A sum over a lattice is no integral: with 2.5 spacings of support it is within some percent of the density.
        assert!((density - 1.0).abs() < 0.03, "density {density}");
        assert!((vx - 2.0 * y).abs() < 1e-6 && (vy + 1.0).abs() < 1e-12 && vz == 0.0, "{vx} {vy} {vz}");
    }
    // Far from all particles there is no velocity.
    let away = [("start", Value::Vector(DVec3::splat(5.0))), ("range", Value::Number(0.25))];
    let found = rows("probe", &state, Bounds::default(), &away).expect("rows");
    assert_eq!(found[0][3..], [Cell::Whole(0), Cell::Number(0.0), Cell::Empty, Cell::Empty, Cell::Empty]);
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let state = crystal(2);
    let refused = |name: &str, bounds: Bounds, sets: &[(&'static str, Value)]| {
        rows(name, &state, bounds, sets).expect_err("refused").to_string()
    };
    let range = |range: f64| ("range", Value::Number(range));
    let start = ("start", Value::Vector(DVec3::ZERO));
    let cube = periodic(DVec3::splat(2.0));
    for (text, why) in [
        (refused("rdf", Bounds::default(), &[range(0.5)]), "is not periodic along all axes"),
        (refused("rdf", cube, &[range(1.01)]), "set it to 1 at most"),
        (refused("rdf", cube, &[range(0.5), ("bins", Value::Number(1e6))]), "set 100000 at most"),
        (
            refused("probe", cube, &[range(0.5), ("start", Value::Vector(DVec3::ZERO)), ("count", Value::Number(1e6))]),
            "set 100000 at most",
        ),
        (refused("fluid", cube, &[]), "this one has none"),
        (
            refused("probe", cube, &[range(0.5), start.clone(), ("count", Value::Number(3.0))]),
            "several points need a span",
        ),
        (
            refused("probe", cube, &[range(0.5), start.clone(), ("span", Value::Vector(DVec3::X))]),
            "a span needs several points",
        ),
        (refused("probe", cube, &[range(1.5), start.clone()]), "set it to 1 at most"),
        (
            refused("probe", Bounds { dimensions: 2, ..cube }, &[range(0.5), ("start", Value::Vector(DVec3::Z))]),
            "set z to 0",
        ),
        (refused("rdf", cube, &[range(0.5), ("others", Value::Number(7.0))]), "no particle is of it"),
        (refused("haloes", Bounds::default(), &[]), "set linking_distance [length]"),
        (refused("haloes", cube, &[("species", Value::Number(7.0))]), "no particle is of it"),
    ] {
        assert!(text.contains(why), "{text}");
    }
}

/// Free particles go straight on through the sides of their box, and keep their velocities.
#[test]
fn displacements_are_not_interrupted_by_sides() {
    let mut state = State::default();
    let velocities = [DVec3::new(1.0, 2.0, -1.5), DVec3::new(-3.0, 0.0, 0.25)];
    velocities.iter().for_each(|v| state.push(DVec3::ONE, *v, 1.0, 0.0));
    let bounds = periodic(DVec3::splat(2.0));
    let refused = rows("diffusion", &state, bounds, &[]).expect_err("no column").to_string();
    assert!(refused.contains("add [[column]] with name = \"unwrapped\""), "{refused}");
    let column = motes::Column::new("unwrapped", motes::Kind::Vector, "length", "").with_rate("velocity");
    state.declare(&column).expect("a column");
    // A run may go on from a state that has gone some way.
    state.set("unwrapped", Array::Vec3(vec![DVec3::splat(0.5); 2])).expect("a column");
    let setup = setup(&state, bounds);
    let settings = Settings::defaults(measure("diffusion").expect("it").keys);
    let mut series = (measure("diffusion").expect("it").begin)(&setup, &settings).expect("a series");
    let cpu = motes::Cpu::new(setup.check().expect("a setup")).expect("threads");
    let mut simulation = motes::Simulation::on(cpu, &setup).expect("a simulation");
    for steps in [0, 40] {
        simulation.step(steps).expect("steps");
        let state = Arc::new(pollster::block_on(simulation.snapshot()).expect("a state"));
        let moment = Moment { state: &state, density: &[], clock: None, links: None, virial: None };
        let row = series.take(&moment).expect("a row");
        let t = 0.1 * f64::from(steps);
        // ½ (1 + 9), ½ (4 + 0) and ½ (2.25 + 0.0625)
        let want = [8.15625 * t * t, 5.0 * t * t, 2.0 * t * t, 1.15625 * t * t, 8.15625];
        for (cell, want) in want.into_iter().enumerate() {
            assert!((numbers(&row, cell)[0] - want).abs() < 1e-10, "{cell}: {:?} is not {want}", row[0][cell]);
        }
        let coefficient = numbers(&row, 5)[0];
        assert!(if steps == 0 { coefficient.is_nan() } else { (coefficient - 8.15625 * t / 6.0).abs() < 1e-10 });
    }
}
