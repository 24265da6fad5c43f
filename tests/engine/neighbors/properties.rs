//! Anywhere, in any box, at any range: searches find exactly those that brute force finds.

use glam::DVec3;
use motes::forces::Over;
use motes::{Bounds, Side};
use proptest::prelude::*;

use crate::neighbors::exact::{by_force, by_sort, found, same};
use crate::neighbors::variants;
use crate::support::{self, Random};

/// How particles lie in a box of unit sides.
#[derive(Debug, Clone, Copy)]
enum Input {
    Random,
    Clustered,
    Lattice,
    Line,
    OnePlace,
}

#[derive(Debug, Clone)]
struct Case {
    input: Input,
    count: usize,
    seed: u64,
    sides: [Side; 3],
    flat: bool,
    low: DVec3,
    size: DVec3,
    range: f64,
    nearest: u32,
}

impl Case {
    fn bounds(&self) -> Bounds {
        let mut bounds = Bounds { low: self.low, high: self.low + self.size, sides: self.sides, dimensions: 3 };
        if self.flat {
            (bounds.low.z, bounds.high.z, bounds.sides[2], bounds.dimensions) = (0.0, 0.0, Side::Open, 2);
        }
        bounds
    }
    /// Inside of the box, where the device's arithmetic and the host's are the same bit for bit.
    fn positions(&self) -> Vec<DVec3> {
        let mut random = Random::new(self.seed);
        let mut number = || 0.5 + 0.499_999 * random.next();
        let mut unit = || DVec3::new(number(), number(), number());
        let center = unit();
        let place = |i: usize| match self.input {
            Input::Random => unit(),
            // A clump, and strays all over the box.
            Input::Clustered if i.is_multiple_of(9) => unit(),
            Input::Clustered => center + (unit() - center) * 0.03,
            Input::Lattice => DVec3::new((i % 8) as f64, (i / 8 % 8) as f64, (i / 64) as f64) / 8.0,
            Input::Line => unit() * DVec3::X + DVec3::new(0.0, 0.25, 0.5),
            Input::OnePlace => center,
        };
        let bounds = self.bounds();
        let (low, size) = (bounds.low, bounds.high - bounds.low);
        let inside = |x: DVec3| (low + size * x).as_vec3().as_dvec3();
        (0..self.count).map(place).map(inside).collect()
    }
}

fn case() -> impl Strategy<Value = Case> {
    let input = prop_oneof![
        3 => Just(Input::Random), 3 => Just(Input::Clustered), 2 => Just(Input::Lattice),
        1 => Just(Input::Line), 1 => Just(Input::OnePlace)
    ];
    let side = || prop_oneof![2 => Just(Side::Periodic), 2 => Just(Side::Open), 1 => Just(Side::Reflecting)];
    let size = || prop_oneof![Just(1.0), Just(2.0), Just(0.25), Just(16.0)];
    let low = || prop_oneof![Just(0.0), Just(-0.5), Just(3.0)];
    // In parts of the longest side, evenly in its logarithm: from none around to all, and the lattice's own distances.
    let range = prop_oneof![3 => (-3.0..0.7_f64).prop_map(|e| 10.0_f64.powf(e)), 1 => Just(0.125), 1 => Just(0.25)];
    (
        (input, 1..400_usize, any::<u64>(), [side(), side(), side()]),
        (prop::bool::weighted(0.3), [low(), low(), low()], [size(), size(), size()], range, 1..=16_u32),
    )
        .prop_map(|((input, count, seed, sides), (flat, low, size, range, nearest))| {
            let (low, size) = (DVec3::from_array(low), DVec3::from_array(size));
            Case { input, count, seed, sides, flat, low, size, range: range * size.max_element(), nearest }
        })
}

fn config(cases: u32) -> ProptestConfig {
    let mut config = ProptestConfig::with_cases(cases);
    config.failure_persistence = None;
    config.max_shrink_iters = 200;
    config.rng_seed = prop::test_runner::RngSeed::Fixed(20);
    config
}

#[test]
fn near_is_within_to_the_bit() {
    proptest!(config(32), |(case in case())| {
        let shared = support::device();
        let (positions, bounds, range) = (case.positions(), case.bounds(), case.range);
        let want = by_force(&positions, &bounds, range);
        for (name, machine) in variants(&shared) {
            let near = found(&shared, Some(machine), &positions, bounds, Over::Near { range, of: None });
            same(&near, &want, &format!("{case:?}, near, {name}"));
            for skin in [None, Some(0.0)] {
                let list = Over::List { range, skin, slots: 0 };
                let list = found(&shared, Some(machine), &positions, bounds, list);
                same(&list, &want, &format!("{case:?}, list with a skin of {skin:?}, {name}"));
            }
        }
        same(&found(&shared, None, &positions, bounds, Over::Within { range }), &want, &format!("{case:?}, within"));
    });
}

#[test]
fn nearest_is_a_sort_to_the_bit() {
    proptest!(config(32), |(case in case())| {
        let shared = support::device();
        let (positions, bounds, count) = (case.positions(), case.bounds(), case.nearest);
        let want = by_sort(&positions, &bounds, count as usize);
        same(&found(&shared, None, &positions, bounds, Over::Nearest { count }), &want, &format!("{case:?}"));
    });
}
