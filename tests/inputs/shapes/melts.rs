//! Chains that fill a lattice.
#![allow(clippy::float_cmp, reason = "numbers that are given are exact")]
#![allow(clippy::cast_possible_truncation, reason = "places are small whole numbers")]

use glam::DVec3;
use motes::State;
use motes::links::Link;
use motes::settings::Value;

use crate::shapes::tied::{assert_refused, made, number, vector};

const CHAINS: &[(&str, Value)] = &[
    ("size", vector(4.0, 6.0, 5.0)),
    ("beads", number(8.0)),
    ("spacing", number(1.5)),
    ("stiffness", number(7.0)),
    ("damping", number(0.3)),
    ("mass", number(2.0)),
    ("center", vector(1.0, 2.0, 3.0)),
    ("velocity", vector(0.1, 0.2, 0.3)),
];

/// Places on the lattice, from its lowest corner on.
fn sites(state: &State) -> Vec<[i64; 3]> {
    let low = DVec3::new(1.0, 2.0, 3.0) - 0.75 * DVec3::new(3.0, 5.0, 4.0);
    let site = |x: &DVec3| {
        let place = (*x - low) / 1.5;
        assert!((place - place.round()).length() < 1e-12, "{x} is no place of the lattice");
        place.round().to_array().map(|n| n as i64)
    };
    state.position().iter().map(site).collect()
}

/// Every place is taken once, bonds join neighbours on the lattice, through the sides where it is periodic, and chains have no bond between them.
#[test]
fn chains_fill_the_lattice() {
    for periodic in [true, false] {
        for seed in [1.0, 2.0, 3.0] {
            let state = made("chains", CHAINS, &[("periodic", Value::Flag(periodic)), ("seed", number(seed))]);
            let sites = sites(&state);
            let mut all = sites.clone();
            all.sort_unstable();
            all.dedup();
            assert_eq!(all.len(), 120);
            assert!(all.iter().all(|site| site.iter().zip([4, 6, 5]).all(|(n, side)| (0..side).contains(n))));
            let springs = &state.links.springs;
            assert_eq!(springs.len(), 120 - 15);
            let mut crossing = 0;
            for Link { ends: [a, b], rest, stiffness, damping, rope } in springs {
                assert!(*b == a + 1 && b % 8 != 0 && !rope, "{a} {b}");
                assert_eq!([*rest, *stiffness, *damping], [1.5, 7.0, 0.3]);
                let apart = |axis: usize| (sites[*a as usize][axis] - sites[*b as usize][axis]).abs();
                let inside: i64 = (0..3).map(apart).sum();
                let through: i64 = (0..3).map(|axis| apart(axis).min([4, 6, 5][axis] - apart(axis))).sum();
                assert!(through == 1 && (periodic || inside == 1), "{a} {b}");
                crossing += usize::from(inside > 1);
            }
            assert_eq!(crossing > 0, periodic, "{crossing}");
            assert!(
                state.velocity().iter().all(|v| *v == DVec3::new(0.1, 0.2, 0.3))
                    && state.mass().iter().all(|m| *m == 2.0)
            );
        }
    }
    // Without moves they lie in rows; with another seed elsewhere; and velocities have their temperature.
    let rows = sites(&made("chains", CHAINS, &[("moves", number(0.0))]));
    assert!((1..4).all(|i| rows[i][1..] == rows[0][1..]) && rows[4][1] == 1, "{rows:?}");
    assert_ne!(made("chains", CHAINS, &[("seed", number(2.0))]), made("chains", CHAINS, &[]));
    let warm = made("chains", CHAINS, &[("temperature", number(0.7))]);
    let mean = DVec3::new(0.1, 0.2, 0.3);
    let twice: f64 = warm.velocity().iter().map(|v| 2.0 * (*v - mean).length_squared()).sum();
    assert!((twice / (3.0 * 120.0 - 3.0) - 0.7).abs() < 1e-12, "{twice}");
}

/// Mean-square end-to-end distances, per bond and in squares of its length. A walk that does not step back has (1 + 1/5) / (1 − 1/5) = 1.5 on this lattice, and
/// less by its ends, 1.49 for 49 bonds; one that never comes to a place again, among others of its kind, is a little wider: 1.61 with 100 moves for each
/// place, and 1.68 with 10. The relative standard error of 160 ideal chains is √(2 / 480) = 0.065, of three seeds 0.06 in all; four of them are allowed.
#[test]
fn chains_are_as_wide_as_walks() {
    let mut all = Vec::new();
    for seed in [1.0, 2.0, 3.0] {
        let size = vector(20.0, 20.0, 20.0);
        let state = made("chains", &[("size", size), ("beads", number(50.0)), ("seed", number(seed))], &[]);
        let side = DVec3::splat(20.0);
        let squares: f64 = state
            .position()
            .chunks(50)
            .map(|chain| {
                let bond = |two: &[DVec3]| (two[1] - two[0]) - side * ((two[1] - two[0]) / side).round();
                chain.windows(2).map(bond).sum::<DVec3>().length_squared()
            })
            .sum();
        all.push(squares / 160.0 / 49.0);
    }
    let mean = all.iter().sum::<f64>() / 3.0;
    assert!((mean - 1.65).abs() < 0.25, "{all:?}");
}

#[test]
fn chains_that_do_not_fit_are_refused() {
    assert_refused(
        "chains",
        CHAINS,
        &[
            ("beads", number(7.0), "120 places are no whole number of chains of 7 beads"),
            ("beads", number(1.0), "beads is 1; a chain has 2 or more"),
            ("size", vector(4.0, 6.5, 5.0), "three whole numbers"),
            ("size", vector(4e4, 4e4, 4e4), "ids beyond"),
            ("spacing", number(0.0), "spacing is 0; it must be above 0"),
            ("mass", number(0.0), "mass is 0; it must be above 0"),
            ("moves", number(-1.0), "moves is -1; it must be 0 or above"),
            ("stiffness", number(-1.0), "stiffness is -1; it must be 0 or above"),
        ],
    );
}

/// A large lattice is cut into blocks, each with a path of its own, so that the time is proportional to its size.
#[test]
fn large_melts_are_made_of_blocks() {
    let given = [("size", vector(48.0, 40.0, 20.0)), ("beads", number(20.0)), ("moves", number(2.0))];
    let state = made("chains", &given, &[]);
    assert_eq!((state.len(), state.links.springs.len()), (38_400, 38_400 - 1920));
    let low = -0.5 * DVec3::new(47.0, 39.0, 19.0);
    let mut all: Vec<[i64; 3]> =
        state.position().iter().map(|x| (*x - low).round().to_array().map(|n| n as i64)).collect();
    for spring in &state.links.springs {
        let [a, b] = spring.ends.map(|end| all[end as usize]);
        let through = |axis: usize| (a[axis] - b[axis]).abs().min([48, 40, 20][axis] - (a[axis] - b[axis]).abs());
        assert_eq!((0..3).map(through).sum::<i64>(), 1, "{a:?} {b:?}");
    }
    all.sort_unstable();
    all.dedup();
    assert!(all.len() == 38_400 && all[0] == [0; 3] && all[38_399] == [47, 39, 19]);
    // 199 and 211 are primes.
    let primes = [("size", vector(199.0, 211.0, 1.0)), ("beads", number(211.0)), ("moves", number(1.0))];
    let cases = [("beads", number(41_989.0), "32768 of one path"), ("moves", number(1e30), "1000 or below")];
    assert_refused("chains", &primes, &cases);
}

/// Chains of one layer move in it, with the temperature of two dimensions.
#[test]
fn a_layer_stays_flat() {
    let given = [("size", vector(20.0, 20.0, 1.0)), ("beads", number(20.0)), ("temperature", number(1.5))];
    let state = made("chains", &given, &[]);
    let twice: f64 = state.velocity().iter().map(|v| v.length_squared()).sum();
    assert!(state.velocity().iter().all(|v| v.z == 0.0) && (twice / 798.0 - 1.5).abs() < 1e-9, "{twice}");
}
