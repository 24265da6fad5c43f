//! Volume fractions and coordination numbers of grains: crystals, and regions whose faces cut spheres.

use std::f64::consts::PI;

use glam::DVec3;
use motes::kernel::Array;
use motes::measure::{Cell, Row};
use motes::settings::Value;
use motes::{Bounds, Side, State};

use crate::measures::{crystal, numbers, periodic, rows};
use crate::support::Random;

/// The same particles with radii.
pub fn with_radii(mut state: State, radius: impl Fn(usize) -> f64) -> State {
    state.declare(&motes::Column::new("radius", motes::Kind::Scalar, "length", "")).expect("a column");
    state.set("radius", Array::Float((0..state.len()).map(radius).collect())).expect("radii");
    state
}

fn packing(state: &State, bounds: Bounds, sets: &[(&'static str, Value)]) -> Vec<Row> {
    rows("packing", state, bounds, sets).expect("rows")
}

fn slabs(axis: &'static str, bins: u32) -> [(&'static str, Value); 2] {
    [("axis", Value::Text(axis.into())), ("bins", Value::Number(bins.into()))]
}

/// A part of the box.
fn part(low: DVec3, high: DVec3) -> [(&'static str, Value); 2] {
    [("low", Value::Vector(low)), ("high", Value::Vector(high))]
}

fn lattice(cells: u32) -> State {
    let mut state = State::default();
    for k in 0..cells.pow(3) {
        let x = [k % cells, k / cells % cells, k / cells / cells].map(f64::from);
        state.push(DVec3::from(x) + 0.3, DVec3::ZERO, 1.0, 0.0);
    }
    state
}

/// 6 and 12 contacts; π / 6 and π / 3√2 of the volume. A radius is by 1e-6 larger than half a distance, and the fraction by three times that.
#[test]
fn crystals_have_their_contacts_and_fractions() {
    let face = 0.125_f64.sqrt();
    let side = DVec3::splat(12.0);
    for (state, side, radius, contacts, want) in
        [(lattice(12), side, 0.5, 6.0, PI / 6.0), (crystal(12), side, face, 12.0, PI / 18.0_f64.sqrt())]
    {
        let state = with_radii(state, |_| radius * (1.0 + 1e-6));
        let row = packing(&state, periodic(side), &[]);
        let [grains, fraction, all, mechanical, rattlers, held] = [2, 3, 4, 5, 6, 7].map(|cell| numbers(&row, cell)[0]);
        assert!((grains - state.len() as f64).abs() < 0.5 && row.len() == 1 && row[0][0] == Cell::Empty);
        assert!((fraction / want - 1.0 - 3e-6).abs() < 1e-8, "{fraction} is not {want}");
        assert!([all, mechanical, held].iter().all(|z| (z - contacts).abs() < 1e-12) && rattlers == 0.0, "{row:?}");
        // A gap of 1e-6 ends all contacts.
        let apart = with_radii(state, |_| radius * (1.0 - 1e-6));
        let row = packing(&apart, periodic(side), &[]);
        assert_eq!(row[0][4..], [0.0.into(), Cell::Empty, 1.0.into(), Cell::Empty]);
    }
}

/// Two thousand overlapping spheres of all sizes in a box that is periodic along two axes, and in a plane: each region has as much of them as
/// random points find there, and slabs share it all. Of 40 000 points each finds n spheres, with a variance below twice the mean of n. Negative
/// control: spheres counted whole where their centres are give something else.
#[test]
fn faces_cut_spheres() {
    for (seed, axis, flat) in [(3, "x", false), (8, "z", false), (5, "y", true)] {
        let mut random = Random::new(seed);
        let size = DVec3::new(4.0, 5.0, if flat { 0.0 } else { 6.0 });
        let mut bounds = periodic(size);
        bounds.sides[1] = Side::Reflecting;
        let mut state = State::default();
        (0..2000).for_each(|_| {
            state.push(0.5 * (random.vector() + 1.0) * size, DVec3::ZERO, 1.0, 0.0);
        });
        let radii: Vec<f64> = (0..2000).map(|_| 0.3 + 0.2 * random.next()).collect();
        let state = with_radii(state, |i| radii[i]);
        let mut worst = 0.0_f64;
        for (low, high) in
            [([0.0, 0.0, 0.0], [4.0, 5.0, 6.0]), ([0.0, 1.3, 0.0], [0.9, 1.8, 6.0]), ([1.1, 4.2, 2.0], [4.0, 5.0, 2.7])]
        {
            let (low, high) = (DVec3::from(low), DVec3::from(high));
            let region = part(low, high);
            let whole = numbers(&packing(&state, bounds, &region), 3)[0];
            let found: usize = (0..15_000)
                .map(|_| {
                    let x = low + 0.5 * (random.vector() + 1.0) * (high - low);
                    let x = if flat { x.with_z(0.0) } else { x };
                    state.position().iter().zip(&radii).filter(|(y, r)| bounds.shortest(x - **y).length() < **r).count()
                })
                .sum();
            let mean = found as f64 / 15_000.0;
            let error = 5.0 * (2.0 * mean / 15_000.0).sqrt();
            assert!((whole - mean).abs() < error, "seed {seed}, {low}: {whole} is not {mean}");
            let all = packing(&state, bounds, &[region.to_vec(), slabs(axis, 7).to_vec()].concat());
            let shared = numbers(&all, 3).iter().sum::<f64>() / 7.0;
            assert!(all.len() == 7 && (shared / whole - 1.0).abs() < 1e-6, "{shared} is not {whole}");
            let inside =
                |x: DVec3| (0..if flat { 2 } else { 3 }).all(|axis| x[axis] >= low[axis] && x[axis] < high[axis]);
            let ball = |r: f64| if flat { PI * r * r } else { 4.0 / 3.0 * PI * r.powi(3) };
            let centres = state.position().iter().zip(&radii).filter(|(x, _)| inside(**x));
            let counted: f64 = centres.map(|(_, r)| ball(*r)).sum();
            let d = high - low;
            let rough = counted / if flat { d.x * d.y } else { d.element_product() };
            worst = worst.max((rough - whole).abs() / error);
        }
        assert!(worst > 2.0, "seed {seed}: {worst}");
    }
}

/// A small grain amid a lattice has no contact, and its six neighbours have five; a line of grains with two contacts each, and one at its
/// ends, has no backbone, since rattlers do not count.
#[test]
fn rattlers_hold_nothing() {
    let state = with_radii(lattice(12), |i| if i == 700 { 0.1 } else { 0.500_001 });
    let row = packing(&state, periodic(DVec3::splat(12.0)), &[]);
    let n = 1728.0;
    let got = [4, 5, 6, 7].map(|cell| numbers(&row, cell)[0]);
    let want = [(6.0 * n - 12.0) / n, (6.0 * n - 12.0) / (n - 1.0), 1.0 / n, (6.0 * n - 12.0) / (n - 1.0)];
    assert!(got.iter().zip(want).all(|(got, want)| (got - want).abs() < 1e-12), "{got:?} {want:?}");

    let mut line = State::default();
    (0..40).for_each(|k| line.push(DVec3::new(0.5, 0.5, 0.3 + 0.1 * f64::from(7 * k % 40)), DVec3::ZERO, 1.0, 0.0));
    let line = with_radii(line, |_| 0.051);
    let of = |least: f64, state: &State| {
        let sets = [("least", Value::Number(least))];
        packing(state, Bounds::new(DVec3::ZERO, DVec3::new(1.0, 1.0, 5.0), Side::Reflecting), &sets)[0][2..].to_vec()
    };
    // (78 − 2) / 38 without the two ends.
    let row = of(2.0, &line);
    assert_eq!(row[2..], [1.95.into(), 2.0.into(), 1.0.into(), Cell::Empty]);
    // Grains that are fixed hold: they need no contacts, and are not counted.
    let mut ends = line;
    ends.held = [0, 17].map(|id| motes::motion::Held { id, by: motes::motion::Hold::Fixed }).to_vec();
    let row = of(2.0, &ends);
    assert_eq!((&row[0], &row[2..]), (&Cell::Whole(38), &[2.0.into(), 2.0.into(), 0.0.into(), 2.0.into()][..]));
}

/// Discs on a square lattice: four contacts, π / 4 of the area, and three contacts hold one.
#[test]
fn discs_have_areas() {
    let mut state = State::default();
    (0..2500).for_each(|k| state.push(DVec3::new(f64::from(k % 50), f64::from(k / 50), 0.0), DVec3::ZERO, 1.0, 0.0));
    // The disc between two holes has two contacts; those beside them have three.
    let state = with_radii(state, |i| if i == 370 || i == 372 { 0.1 } else { 0.500_001 });
    let bounds = periodic(DVec3::new(50.0, 50.0, 0.0));
    let row = packing(&state, bounds, &[]);
    let [fraction, rattlers] = [3, 6].map(|cell| numbers(&row, cell)[0]);
    let want = PI / 4.0 * (2498.0 * 1.000_002_f64.powi(2) + 0.08) / 2500.0;
    assert!((fraction - want).abs() < 1e-9 && (rattlers - 3.0 / 2500.0).abs() < 1e-12, "{fraction} {want} {rattlers}");
    let four = packing(&state, bounds, &[("least", Value::Number(4.0))]);
    assert!(numbers(&four, 6)[0] > 8.5 / 2500.0, "its neighbours have three");
}

#[test]
fn regions_without_a_volume_are_refused() {
    let state = with_radii(crystal(2), |_| 0.1);
    let cube = periodic(DVec3::splat(2.0));
    let refused = |state: &State, bounds: Bounds, sets: &[(&'static str, Value)]| {
        rows("packing", state, bounds, sets).expect_err("refused").to_string()
    };
    let flat = Bounds { dimensions: 2, ..cube };
    for (text, why) in [
        (refused(&crystal(2), cube, &[]), "no particle has a radius"),
        (refused(&state, Bounds::default(), &[]), "open along x: set low and high"),
        (refused(&state, Bounds::default(), &part(DVec3::ZERO, DVec3::new(1.0, 1.0, 0.0))), "open along z"),
        (refused(&state, cube, &[("bins", Value::Number(3.0))]), "bins = 3 and no axis"),
        (refused(&state, cube, &slabs("x", 1_000_000)), "set 100000 at most"),
        (refused(&state, flat, &slabs("z", 3)), "choose \"x\" or \"y\""),
        (refused(&state, cube, &part(DVec3::ONE, DVec3::new(0.5, 2.0, 2.0))), "low = 1 above high = 0.5 along x"),
        (
            refused(&state, cube, &part(DVec3::ZERO, DVec3::splat(2.5))),
            "beyond the sides of the periodic box at 0 and 2",
        ),
    ] {
        assert!(text.contains(why), "{text}");
    }
}
