//! The stress of grains in states that are known: gases, pairs, cells that share lines between centres, and a shear flow.

use std::f64::consts::PI;
use std::sync::Arc;

use glam::DVec3;
use motes::forces::{Component, Custom, Over};
use motes::measure::{Cell, Moment, Row, measure};
use motes::motion::{Held, Hold};
use motes::settings::{Settings, Value};
use motes::{Bounds, Error, Setup, Side, State};

use crate::measures::{numbers, periodic};
use crate::packing::with_radii;
use crate::support::Random;
use crate::support::states::force;

const STIFFNESS: f64 = 300.0;
/// The first of nine cells.
const TENSOR: usize = 5;

fn contact(range: f64) -> Box<dyn Component> {
    force("contact", &[("range", range.into()), ("stiffness", STIFFNESS.into()), ("tangential_damping", 0.0.into())])
}

/// The rows of a state under some forces.
fn stress(
    state: &State,
    forces: Vec<Box<dyn Component>>,
    bounds: Bounds,
    sets: &[(&'static str, Value)],
) -> Result<Vec<Row>, Error> {
    let measure = measure("stress").expect("a measure");
    let settings = sets.iter().fold(Settings::defaults(measure.keys), |all, (key, value)| all.with(key, value.clone()));
    let integrator = motes::integrators::INTEGRATORS[0].by_default();
    let solver = motes::Solver::default();
    let setup = Setup { state: state.clone(), forces, integrator, dt: 0.1, bounds, solver };
    let mut series = (measure.begin)(&setup, &settings)?;
    let state = Arc::new(state.clone());
    series.take(&Moment { state: &state, density: &[], clock: None, links: None, virial: None })
}

/// The nine numbers of a tensor, row by row.
fn tensor(row: &Row) -> [f64; 9] {
    std::array::from_fn(|k| numbers(std::slice::from_ref(row), TENSOR + k)[0])
}

fn near(got: &[f64], want: &[f64], allowed: f64) {
    assert!(got.iter().zip(want).all(|(a, b)| (a - b).abs() < allowed), "{got:?} is not {want:?}");
}

/// Spheres in a periodic box that fills 3 × 4 × 5.
fn spheres(seed: u64, count: usize, radius: f64, mean: DVec3) -> State {
    let mut random = Random::new(seed);
    let mut state = State::default();
    for _ in 0..count {
        let x = 0.5 * (random.vector() + 1.0) * DVec3::new(3.0, 4.0, 5.0);
        state.push(x, mean + random.vector(), 1.5 + 0.5 * random.next(), 0.0);
    }
    with_radii(state, |_| radius)
}

/// Grains that touch nothing are an ideal gas: Σ m v ⊗ v / V relative to their mean velocity, and a third of the trace is the pressure.
#[test]
fn grains_apart_are_an_ideal_gas() {
    for seed in [4, 9] {
        let state = spheres(seed, 500, 1e-9, DVec3::new(3.0, -2.0, 1.0));
        let rows = stress(&state, vec![contact(1.0)], periodic(DVec3::new(3.0, 4.0, 5.0)), &[]).expect("a row");
        let mass: f64 = state.mass().iter().sum();
        let mean = state.velocity().iter().zip(state.mass()).map(|(v, m)| *m * *v).sum::<DVec3>() / mass;
        let want: [f64; 9] = std::array::from_fn(|k| {
            let of = |(v, m): (&DVec3, &f64)| m * (*v - mean)[k / 3] * (*v - mean)[k % 3];
            state.velocity().iter().zip(state.mass()).map(of).sum::<f64>() / 60.0
        });
        near(&tensor(&rows[0]), &want, 1e-10);
        let pressure = (want[0] + want[4] + want[8]) / 3.0;
        let [p, q, own] = [2, 3, 4].map(|cell| numbers(&rows, cell)[0]);
        near(&[p, own], &[pressure; 2], 1e-10);
        let s = |k: usize| want[k] - if k.is_multiple_of(4) { pressure } else { 0.0 };
        near(&[q], &[(1.5 * (0..9).map(|k| s(k).powi(2)).sum::<f64>()).sqrt()], 1e-10);
        // Without an axis nothing changes along it.
        assert_eq!(rows[0][14..], [Cell::Empty, Cell::Empty]);
    }
}

/// Two spheres that overlap by δ: n ⊗ n k δ (R₁ + R₂ − δ) / V. Where the second is fixed its half is outside of the grains: the line ends where they
/// touch. Two fixed ones transmit nothing.
#[test]
fn two_grains_have_the_stress_of_their_contact() {
    let n = DVec3::new(2.0, -1.0, 2.0) / 3.0;
    let (radii, overlap) = ([0.4, 0.5], 0.02);
    let mut state = State::default();
    for distance in [0.0, 0.9 - overlap] {
        state.push(DVec3::splat(1.5) + distance * n, DVec3::ZERO, 1.0, 0.0);
    }
    let mut state = with_radii(state, |i| radii[i]);
    let bounds = periodic(DVec3::splat(4.0));
    for (fixed, length) in
        [(vec![], 0.9 - overlap), (vec![1], 0.4 - 0.5 * overlap), (vec![0], 0.5 - 0.5 * overlap), (vec![0, 1], 0.0)]
    {
        state.held = fixed.iter().map(|id| Held { id: *id, by: Hold::Fixed }).collect();
        let row = &stress(&state, vec![contact(1.0)], bounds, &[]).expect("a row")[0];
        let scale = STIFFNESS * overlap * length / 64.0;
        let want: [f64; 9] = std::array::from_fn(|k| scale * n[k / 3] * n[k % 3]);
        near(&tensor(row), &want, 1e-12);
        let [p, q] = [2, 3].map(|cell| numbers(std::slice::from_ref(row), cell)[0]);
        // A uniaxial stress s has p = s / 3 and q = s.
        near(&[p, q], &[scale / 3.0, scale], 1e-12);
    }
}

/// In two dimensions volumes are areas, p is a half of the trace, and q of a uniaxial stress too.
#[test]
fn discs_in_a_plane_have_their_stress() {
    let mut state = State::default();
    [0.0, 0.9].into_iter().for_each(|y| state.push(DVec3::new(1.0, 1.0 + y, 0.0), DVec3::ZERO, 1.0, 0.0));
    let state = with_radii(state, |_| 0.5);
    let bounds = Bounds { dimensions: 2, ..periodic(DVec3::new(4.0, 5.0, 0.0)) };
    let row = &stress(&state, vec![contact(1.0)], bounds, &[]).expect("a row")[0];
    let want = STIFFNESS * 0.1 * 0.9 / 20.0;
    let [p, q, yy] = [2, 3, 9].map(|cell| numbers(std::slice::from_ref(row), cell)[0]);
    near(&[p, q, yy], &[0.5 * want, 0.5 * want, want], 1e-12);
}

/// Slabs along any axis, and octants, share lines between centres across the sides of a periodic box: their mean is the stress of the whole, and
/// cells differ. Negative control: half of the slabs have another mean.
#[test]
fn cells_share_lines_between_centres() {
    for seed in [2, 7] {
        let size = DVec3::new(3.0, 4.0, 5.0);
        let state = spheres(seed, 300, 0.35, DVec3::ZERO);
        let still = {
            let mut state = state;
            state.velocity_mut().fill(DVec3::ZERO);
            state
        };
        let of =
            |sets: &[(&'static str, Value)]| stress(&still, vec![contact(0.8)], periodic(size), sets).expect("rows");
        let whole = tensor(&of(&[])[0]);
        let mean = |rows: &[Row]| -> [f64; 9] {
            std::array::from_fn(|k| rows.iter().map(|row| tensor(row)[k]).sum::<f64>() / rows.len() as f64)
        };
        assert!(whole[0] > 1.0, "{whole:?}");
        for axis in ["x", "y", "z"] {
            let rows = of(&[("axis", Value::Text(axis.into())), ("bins", 7.0.into())]);
            assert!(rows.len() == 7);
            near(&mean(&rows), &whole, 1e-10);
            assert!((mean(&rows[..3])[0] - whole[0]).abs() > 1e-3 * whole[0]);
        }
        let corner = |k: usize| DVec3::new((k & 1) as f64, (k >> 1 & 1) as f64, (k >> 2) as f64);
        let octant = |k: usize| {
            let low = 0.5 * size * corner(k);
            of(&[("low", Value::Vector(low)), ("high", Value::Vector(low + 0.5 * size))]).remove(0)
        };
        near(&mean(&(0..8).map(octant).collect::<Vec<_>>()), &whole, 1e-10);
    }
}

/// A lattice that shears by v = γ z along x: each slab has its rate, at the ends too, and the inertial number of its pressure. Each sphere overlaps six
/// others by δ: a contact along each axis in a cell of a³, so that p = k δ / a².
#[test]
fn a_shear_flow_has_its_inertial_number() {
    let (rate, a, radius, mass) = (0.3, 1.0, 0.505, 1.25);
    let mut state = State::default();
    for k in 0..6 * 6 * 8 {
        let cell = DVec3::new(f64::from(k % 6), f64::from(k / 6 % 6), f64::from(k / 36)) + 0.5;
        state.push(a * cell, DVec3::new(rate * cell.z, 0.0, 0.7), mass, 0.0);
    }
    let state = with_radii(state, |_| radius);
    let mut bounds = periodic(DVec3::new(6.0, 6.0, 8.0));
    bounds.sides[2] = Side::Reflecting;
    let slabs = [("axis", Value::Text("z".into())), ("bins", 4.0.into())];
    let frictionless = force(
        "contact",
        &[
            ("range", 1.1.into()),
            ("stiffness", STIFFNESS.into()),
            ("friction", 0.0.into()),
            ("restitution", 1.0.into()),
        ],
    );
    let rows = stress(&state, vec![frictionless], bounds, &slabs).expect("rows");
    near(&numbers(&rows, 14), &[rate; 4], 1e-12);
    let p = STIFFNESS * 0.01 / (a * a);
    let density = mass / (4.0 / 3.0 * PI * radius.powi(3));
    let want = rate * 2.0 * radius * (density / p).sqrt();
    // Two layers in a slab move at ± γ a / 2 relative to their mean: m (γ a / 2)² / a³ along x, a third of which is in the pressure.
    let kinetic = mass * (0.5 * rate * a).powi(2) / 3.0;
    near(&numbers(&rows, 4), &[kinetic; 4], 1e-12);
    for middle in [1, 2] {
        near(&numbers(&rows, 2)[middle..=middle], &[p + kinetic], 1e-10);
        near(&numbers(&rows, 15)[middle..=middle], &[want * (p / (p + kinetic)).sqrt()], 1e-10);
    }
}

/// Scenes without contacts, and those whose contacts are by a law of one's own, are refused.
#[test]
fn forces_that_are_not_known_are_named() {
    let state = spheres(3, 5, 0.1, DVec3::ZERO);
    let bounds = periodic(DVec3::new(3.0, 4.0, 5.0));
    let fault = |forces| match stress(&state, forces, bounds, &[]) {
        Err(Error::Scene(text)) => text,
        other => panic!("{other:?}"),
    };
    assert!(fault(vec![force("uniform", &[])]).contains("add a force of kind `contact`"));
    let law = include_str!("../../examples/own_contact/bridge.wgsl");
    let over = Over::List { range: 1.0, skin: None, slots: 4 };
    let own: Box<dyn Component> = Box::new(Custom::new("bridge", "bridge.wgsl", law, over));
    assert!(fault(vec![own, contact(1.0)]).contains("`bridge` is another law"));
}
