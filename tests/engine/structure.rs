//! The structure factor: against direct sums, of a gas, of a crystal, of two species, and its mean.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "numbers of waves are small, and counts are"
)]
#![allow(clippy::float_cmp, reason = "counts are exact")]

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::Arc;

use glam::DVec3;
use motes::measure::{Cell, Moment, Row, Series, measure};
use motes::settings::{Settings, Value};
use motes::{Bounds, Error, Side, State};

use crate::measures::{numbers, periodic, rows, setup};
use crate::support::Random;

fn set(largest: f64, bins: f64, vectors: f64) -> Vec<(&'static str, Value)> {
    vec![("largest", Value::Number(largest)), ("bins", Value::Number(bins)), ("vectors", Value::Number(vectors))]
}

/// Particles anywhere in a box; the second part of them is of species 1.
fn gas(size: DVec3, count: usize, first: usize, seed: u64) -> State {
    let (mut random, mut state) = (Random::new(seed), State::default());
    for i in 0..count {
        let x = DVec3::new(random.next(), random.next(), random.next());
        state.push(x * size, DVec3::ZERO, 1.0, 0.0);
        state.species_mut()[i] = u32::from(i >= first);
    }
    state
}

fn plane(size: DVec3) -> Bounds {
    let mut bounds = periodic(size);
    (bounds.dimensions, bounds.sides[2]) = (2, Side::Open);
    bounds
}

/// All wave vectors up to a wave number, k and −k.
fn vectors(size: DVec3, largest: f64) -> Vec<DVec3> {
    let most = |side: f64| if side > 0.0 { (largest * side / TAU) as i32 + 1 } else { 0 };
    let [x, y, z] = size.to_array().map(most);
    let step = size.to_array().map(|side| if side > 0.0 { TAU / side } else { 0.0 });
    let mut all = Vec::new();
    for a in -x..=x {
        for b in -y..=y {
            for c in -z..=z {
                let k = DVec3::from(step) * DVec3::new(f64::from(a), f64::from(b), f64::from(c));
                if k.length() > 0.0 && k.length() <= largest {
                    all.push(k);
                }
            }
        }
    }
    all
}

/// Each vector and each particle by sine and cosine; particles are more than are tabulated at once, and no multiple of four.
#[test]
fn sums_are_those_of_each_vector_and_particle() {
    for (size, seed) in [(DVec3::new(3.0, 2.0, 2.5), 3), (DVec3::new(1.5, 2.0, 4.0), 4), (DVec3::new(3.0, 2.0, 0.0), 5)]
    {
        let bounds = if size.z > 0.0 { periodic(size) } else { plane(size) };
        let state = gas(size, 301, 120, seed);
        let (largest, bins) = (11.0, 15);
        for pair in [[None, None], [Some(0), Some(1)], [Some(1), None]] {
            let mut sets = set(largest, f64::from(bins), 1e6);
            let of = |one: Option<u32>| one.map_or(Value::Text("all".into()), |species| Value::Number(species.into()));
            sets.extend([("species", of(pair[0])), ("others", of(pair[1]))]);
            let have = rows("structure_factor", &state, bounds, &sets).expect("rows");
            let density = |of: Option<u32>, k: DVec3| {
                let chosen = || (0..state.len()).filter(|i| of.is_none_or(|one| state.species()[*i] == one));
                let sum = |part: fn(f64) -> f64| chosen().map(|i| part(k.dot(state.position()[i]))).sum::<f64>();
                ([sum(f64::cos), sum(f64::sin)], chosen().count() as f64)
            };
            let mut want: BTreeMap<usize, Vec<[f64; 2]>> = BTreeMap::new();
            for k in vectors(size, largest) {
                let (a, many) = density(pair[0], k);
                let (b, others) = density(pair[1], k);
                let s = (a[0] * b[0] + a[1] * b[1]) / (many * others).sqrt();
                want.entry((k.length() / largest * f64::from(bins)) as usize).or_default().push([k.length(), s]);
            }
            assert_eq!(have.len(), want.len());
            for (row, want) in have.iter().zip(want.values()) {
                let row = std::slice::from_ref(row);
                let mean = |part: usize| want.iter().map(|one| one[part]).sum::<f64>() / want.len() as f64;
                assert_eq!(numbers(row, 3), [want.len() as f64 / 2.0], "k and −k are one");
                assert!((numbers(row, 0)[0] - mean(0)).abs() < 1e-9);
                // Sums of 301 numbers, by powers of up to ten factors each.
                assert!((numbers(row, 1)[0] - mean(1)).abs() < 1e-9, "{} {}", numbers(row, 1)[0], mean(1));
                assert_eq!(numbers(row, 1), numbers(row, 2), "the mean of one state");
            }
        }
    }
}

/// |ρ_k|² / N of a gas has an exponential distribution of mean 1, independently for each k up to 1 / N: the mean of n is off by 1 / √n. The sum
/// of n (s − 1)² over B intervals is B, with a variance of (2 + 6 / n) B.
#[test]
fn a_gas_has_one_with_the_scatter_of_independent_waves() {
    for (seed, flat, most) in [(3, false, 1e6), (7, false, 40.0), (8, false, 20.0), (11, true, 1e6), (13, true, 30.0)] {
        let size = DVec3::new(3.0, 2.0, if flat { 0.0 } else { 2.5 });
        let bounds = if flat { plane(size) } else { periodic(size) };
        let state = gas(size, 3000, 3000, seed);
        let have =
            rows("structure_factor", &state, bounds, &set(if flat { 60.0 } else { 25.0 }, 30.0, most)).expect("rows");
        let (s, n) = (numbers(&have, 1), numbers(&have, 3));
        let all: f64 = n.iter().sum();
        let mean = s.iter().zip(&n).map(|(s, n)| s * n).sum::<f64>() / all;
        assert!((mean - 1.0).abs() < 4.0 / all.sqrt(), "seed {seed}: {mean} of {all}");
        // Of one or two waves the distribution is far from a normal one.
        let many = s.iter().zip(&n).filter(|(_, n)| **n > 8.0);
        many.clone().for_each(|(s, n)| assert!((s - 1.0).abs() < 5.0 / n.sqrt(), "seed {seed}: {s} of {n}"));
        let count = many.clone().count() as f64;
        let square: f64 = many.map(|(s, n)| n * (s - 1.0).powi(2)).sum();
        assert!((square - count).abs() < 4.0 * (2.75 * count).sqrt(), "seed {seed}: {square} of {count}");
    }
}

/// A simple cubic lattice of four particles along each side: N at 2 π (h, k, l), which alone have a multiple of 16 as the sum of the squares of
/// their numbers of waves, and 0 at all others.
#[test]
fn a_crystal_has_its_reciprocal_vectors() {
    let mut state = State::default();
    for k in 0..64 {
        let x = DVec3::new(f64::from(k % 4), f64::from(k / 4 % 4), f64::from(k / 16));
        state.push(x + 0.3, DVec3::ZERO, 1.0, 0.0);
    }
    let unit = TAU / 4.0;
    // √65 − √64 is 0.06 of the longest wave.
    let have =
        rows("structure_factor", &state, periodic(DVec3::splat(4.0)), &set(8.2 * unit, 8.2 / 0.05, 1e6)).expect("rows");
    let (k, s) = (numbers(&have, 0), numbers(&have, 1));
    let mut peaks = Vec::new();
    for (k, s) in k.iter().zip(s) {
        let square = (k / unit).powi(2);
        assert!((square - square.round()).abs() < 1e-6, "one shell to an interval");
        let is_peak = (square.round() as u64).is_multiple_of(16);
        assert!((s - if is_peak { 64.0 } else { 0.0 }).abs() < 1e-9, "S({square}) = {s}");
        peaks.extend(is_peak.then_some(square.round() as u64));
    }
    assert_eq!(peaks, [16, 32, 48, 64]);
}

/// N S = N₁ S₁₁ + N₂ S₂₂ + 2 √(N₁ N₂) S₁₂, of the same vectors.
#[test]
fn parts_of_species_add_up() {
    let size = DVec3::new(2.0, 3.0, 2.5);
    let state = gas(size, 700, 200, 9);
    let of = |pair: Option<[f64; 2]>| {
        let mut sets = set(20.0, 15.0, 25.0);
        sets.extend(pair.into_iter().flat_map(|[a, b]| [("species", Value::Number(a)), ("others", Value::Number(b))]));
        numbers(&rows("structure_factor", &state, periodic(size), &sets).expect("rows"), 1)
    };
    let ([all, one], [two, both]) = ([of(None), of(Some([0.0, 0.0]))], [of(Some([1.0, 1.0])), of(Some([0.0, 1.0]))]);
    assert_eq!(both, of(Some([1.0, 0.0])));
    for k in 0..all.len() {
        let sum = 200.0 * one[k] + 500.0 * two[k] + 2.0 * (200.0_f64 * 500.0).sqrt() * both[k];
        assert!((sum - 700.0 * all[k]).abs() < 1e-9 * 700.0 * all[k].max(1.0), "{sum} {}", all[k]);
        assert!((one[k] - all[k]).abs() > 1e-6, "parts differ");
    }
}

/// Of many wave vectors so many are taken, and they are spread over the interval.
#[test]
fn vectors_are_bounded_and_spread() {
    let (size, largest, bins) = (DVec3::new(6.0, 5.0, 7.0), 20.0, 10.0);
    let state = gas(size, 50, 50, 2);
    let of = |most: f64| rows("structure_factor", &state, periodic(size), &set(largest, bins, most)).expect("rows");
    let (some, all) = (of(60.0), of(1e6));
    for (some, all) in some.iter().zip(&all) {
        let [some, all] = [some, all].map(std::slice::from_ref);
        assert_eq!(numbers(some, 3)[0], numbers(all, 3)[0].min(60.0));
        // 60 numbers, spread over a width of 2: 2 / √(12 · 60) = 0.075.
        assert!((numbers(some, 0)[0] - numbers(all, 0)[0]).abs() < 4.0 * 0.075);
    }
    assert!(numbers(&all, 3).iter().any(|n| *n > 1000.0));
    // Two particles have 1 + cos(k · d): in all directions alike 1 + sin(k d) / k d, which is 1.45 at k d = 2, and 2 where k is across d. Sixty
    // independent cosines would scatter by 0.05.
    for axis in [DVec3::X, DVec3::Y, DVec3::Z] {
        let mut state = State::default();
        [DVec3::ONE, DVec3::ONE + 0.1 * axis].into_iter().for_each(|x| state.push(x, DVec3::ZERO, 1.0, 0.0));
        let have = rows("structure_factor", &state, periodic(size), &set(largest, bins, 60.0)).expect("rows");
        let [k, s] = [0, 1].map(|cell| numbers(&have, cell)[9]);
        let want = 1.0 + (0.1 * k).sin() / (0.1 * k);
        assert!((s - want).abs() < 0.1, "along {axis} {s} and not {want}");
    }
}

fn begun(state: &State, bounds: Bounds, sets: &[(&'static str, Value)]) -> Result<Box<dyn Series>, Error> {
    let measure = measure("structure_factor").expect("a measure");
    let settings = sets.iter().fold(Settings::defaults(measure.keys), |all, (key, value)| all.with(key, value.clone()));
    (measure.begin)(&setup(state, bounds), &settings)
}

fn taken(series: &mut dyn Series, state: &State) -> Vec<Row> {
    let moment = Moment { state: &Arc::new(state.clone()), density: &[], clock: None, links: None, virial: None };
    series.take(&moment).expect("rows")
}

/// The mean is that of the states from `after` on, and goes on to the same bits when rows are read back.
#[test]
fn the_mean_is_that_of_the_states_that_count() {
    let size = DVec3::new(2.0, 3.0, 2.5);
    let mut sets = set(12.0, 6.0, 30.0);
    sets.push(("after", Value::Number(1.0)));
    let at = |step: u64| {
        let mut state = gas(size, 100, 100, 20 + step);
        (state.step, state.time) = (step, 0.5 * step as f64);
        state
    };
    let states: Vec<State> = (0..5).map(at).collect();
    let mut series = begun(&states[0], periodic(size), &sets).expect("a series");
    let all: Vec<Vec<Row>> = states.iter().map(|state| taken(&mut *series, state)).collect();
    assert!(all[..2].iter().flatten().all(|row| row[2] == Cell::Empty), "before `after` nothing counts");
    for bin in 0..all[0].len() {
        let s: Vec<f64> = all[2..].iter().map(|rows| numbers(&rows[bin..=bin], 1)[0]).collect();
        let want = s.iter().sum::<f64>() / 3.0;
        assert!((numbers(&all[4][bin..=bin], 2)[0] - want).abs() < 1e-12);
    }
    let mut again = begun(&states[0], periodic(size), &sets).expect("a series");
    for (state, rows) in states.iter().zip(&all).take(4) {
        for row in rows {
            let cells: Vec<String> =
                std::iter::once(format!("{:?}", state.time)).chain(row.iter().map(Cell::to_string)).collect();
            again.recall(state.step, &cells.iter().map(String::as_str).collect::<Vec<_>>());
        }
    }
    assert_eq!(taken(&mut *again, &states[4]), all[4]);
}

#[test]
fn what_a_box_does_not_admit_is_refused() {
    let size = DVec3::new(2.0, 3.0, 2.5);
    let state = gas(size, 20, 20, 1);
    let mut open = periodic(size);
    open.sides[1] = Side::Open;
    let why = |bounds, sets: &[_]| begun(&state, bounds, sets).map(drop).expect_err("refused").to_string();
    assert!(why(open, &set(9.0, 9.0, 9.0)).contains("not periodic along all axes"));
    assert!(why(periodic(size), &set(2.0, 9.0, 9.0)).contains("set it to 2.0943951023931953 at least"));
    assert!(begun(&state, periodic(size), &set(2.0943951023931953, 9.0, 9.0)).is_ok());
    assert!(why(periodic(size), &set(1e5, 9.0, 9.0)).contains("wave vectors: set it to"));
    assert!(why(periodic(size), &set(9.0, 1e7, 9.0)).contains("set 100000 at most"));
    assert!(
        why(periodic(DVec3::splat(40.0)), &set(25.0, 1e4, 1e6)).contains("choose fewer `vectors`, or fewer `bins`")
    );
    // What is proposed is admitted.
    let words = why(periodic(size), &set(1e5, 9.0, 9.0));
    let most: f64 = words
        .split("set it to ")
        .nth(1)
        .and_then(|rest| rest.split(' ').next())
        .and_then(|x| x.parse().ok())
        .expect("a number");
    assert!(most > 500.0 && begun(&state, periodic(size), &set(most, 9.0, 9.0)).is_ok(), "{words}");
}
