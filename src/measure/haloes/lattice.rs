//! Sets of particles that chains of pairs join, by cells so small that all particles in one are pairs.

use std::collections::BTreeMap;
use std::ops::RangeInclusive;

use glam::DVec3;
use rayon::prelude::*;

use crate::kernel::{Bounds, extent};
use crate::measure::flock::Sets;

/// The width of a cell in units of the linking length over √d: less than 1, so that rounding moves no two particles of a cell too far apart.
const NARROW: f64 = 0.999;
/// The maximum number of a cell: beyond it, positions that differ by rounding alone are in different cells.
const FARTHEST: f64 = 1e15;
/// Up to this number of pairs of particles in two cells, all are tried.
const FEW: usize = 64;

/// The groups of `members` particles or more, each by their places in a list, ascending. Positions are finite, and inside of a periodic box;
/// one that is farther than 10¹⁵ cells away is in no group.
///
/// Sorting takes O(N log N). Each cell looks at the occupied ones up to two away on each side. Two that chains join already are passed over, and
/// a join ends with the first pair, so that it does not matter how many particles a cell has. Of two cells that no chain joins, particles
/// within the linking length of the box around the others are tried with each other: these are many only where two dense clumps lie beside each
/// other at little more than that.
pub(super) fn groups(places: &[DVec3], bounds: &Bounds, distance: f64, members: u64) -> Vec<Vec<usize>> {
    if places.is_empty() || distance <= 0.0 {
        return Vec::new();
    }
    let lattice = Lattice::new(places, bounds, distance);
    let mut sets = lattice.sets();
    let mut found: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for (slot, place) in lattice.order.iter().enumerate() {
        if u64::from(sets.size(slot)) >= members {
            found.entry(sets.root(slot)).or_default().push(*place);
        }
    }
    let mut groups: Vec<Vec<usize>> = found.into_values().collect();
    for group in &mut groups {
        group.sort_unstable();
    }
    groups
}

/// Cells along an axis.
#[derive(Debug, Clone, Copy)]
struct Axis {
    low: f64,
    /// One over the width of a cell \[1 / length\].
    per_cell: f64,
    /// The number of cells along a period; 0 without one.
    cells: i64,
    /// The number of cells on each side in which pairs may lie.
    reach: i64,
}

impl Axis {
    fn of(bounds: &Bounds, axis: usize, distance: f64) -> Self {
        let width = NARROW * distance / f64::from(bounds.dimensions).sqrt();
        let period = bounds.period()[axis];
        #[expect(clippy::cast_possible_truncation, reason = "whole, and far below 2^63")]
        let whole = |x: f64| x.min(FARTHEST) as i64;
        // A period is divided into whole cells.
        let count = (period / width).ceil().clamp(1.0, FARTHEST);
        let (low, per_cell, cells) =
            if period > 0.0 { (bounds.low[axis], count / period, whole(count)) } else { (0.0, 1.0 / width, 0) };
        Self { low, per_cell, cells, reach: whole((1.001 * distance * per_cell).ceil()) }
    }
    /// The cell of a position; none where it is too far away.
    fn cell(&self, x: f64) -> Option<i64> {
        let cell = ((x - self.low) * self.per_cell).floor();
        #[expect(clippy::cast_possible_truncation, reason = "saturates; what is too far away is none")]
        let whole = cell as i64;
        let inside = if self.cells > 0 { whole.clamp(0, self.cells - 1) } else { whole };
        (-FARTHEST..=FARTHEST).contains(&cell).then_some(inside)
    }
    /// How far a search reaches that goes up to `near` cells, and whether it then visits all cells of a period.
    fn reached(&self, near: i64) -> (i64, bool) {
        let reach = self.reach.min(near);
        (reach, self.cells > 0 && 2 * reach + 1 >= self.cells)
    }
    /// The ways to the cells around one: each is visited once.
    fn ways(&self, near: i64) -> RangeInclusive<i64> {
        let (reach, all) = self.reached(near);
        let last = self.cells - 1;
        if all { 0..=last } else { -reach..=reach }
    }
    /// The cell that far from another.
    fn at(&self, cell: i64, way: i64) -> i64 {
        let to = cell + way;
        if self.cells == 0 {
            to
        } else if to < 0 {
            to + self.cells
        } else if to >= self.cells {
            to - self.cells
        } else {
            to
        }
    }
    /// The first and the last of the cells around one; where they go on at the other side of the box, of both parts. A part that is not there ends
    /// before it begins.
    fn runs(&self, cell: i64, near: i64) -> [(i64, i64); 2] {
        const NONE: (i64, i64) = (0, -1);
        let (reach, all) = self.reached(near);
        let (low, high) = (cell - reach, cell + reach);
        if all {
            [(0, self.cells - 1), NONE]
        } else if self.cells > 0 && low < 0 {
            [(0, high), (low + self.cells, self.cells - 1)]
        } else if self.cells > 0 && high >= self.cells {
            [(low, self.cells - 1), (0, high - self.cells)]
        } else {
            [(low, high), NONE]
        }
    }
}

/// Particles, sorted by cells in each of which all are linked.
struct Lattice {
    bounds: Bounds,
    distance: f64,
    axes: [Axis; 3],
    /// Where the cells with particles are, along z, y and x, ascending. Some may be at the same place.
    keys: Vec<[i64; 3]>,
    /// The first particle of each cell; one more than there are cells.
    starts: Vec<usize>,
    /// The particles, cell by cell.
    places: Vec<DVec3>,
    /// Their places in the list.
    order: Vec<usize>,
}

impl Lattice {
    fn new(list: &[DVec3], bounds: &Bounds, distance: f64) -> Self {
        let axes = [0, 1, 2].map(|axis| Axis::of(bounds, axis, distance));
        let keyed = |i: usize| {
            let [x, y, z] = list[i].to_array();
            Some(([axes[2].cell(z)?, axes[1].cell(y)?, axes[0].cell(x)?], i))
        };
        let mut sorted: Vec<([i64; 3], usize)> = (0..list.len()).into_par_iter().filter_map(keyed).collect();
        sorted.par_sort_unstable();
        let order: Vec<usize> = sorted.iter().map(|(_, i)| *i).collect();
        let places: Vec<DVec3> = order.iter().map(|i| list[*i]).collect();
        let (mut keys, mut starts, mut first) = (Vec::new(), Vec::new(), 0);
        for those in sorted.chunk_by(|a, b| a.0 == b.0) {
            let end = first + those.len();
            let (low, high) = extent(&places[first..end]);
            // Where rounding has moved two too far apart, each has a cell of its own.
            let each = if (high - low).length() < distance { those.len() } else { 1 };
            for start in (first..end).step_by(each) {
                keys.push(those[0].0);
                starts.push(start);
            }
            first = end;
        }
        starts.push(first);
        Self { bounds: *bounds, distance, axes, keys, starts, places, order }
    }
    /// The sets of particles that are joined, cell by cell.
    fn sets(&self) -> Sets {
        let mut sets = Sets::new(self.places.len());
        for ends in self.starts.windows(2) {
            (ends[0] + 1..ends[1]).for_each(|i| sets.join(ends[0], i));
        }
        // Cells side by side first: these join most of what is dense.
        for near in [1, i64::MAX] {
            let rows = self.rows(near);
            let mut hints = vec![[0; 2]; rows.len()];
            for (one, key) in self.keys.iter().enumerate() {
                let runs = self.axes[0].runs(key[2], near);
                for (row, hints) in rows.iter().zip(&mut hints) {
                    let (z, y) = (self.axes[2].at(key[0], row[0]), self.axes[1].at(key[1], row[1]));
                    for ((low, high), hint) in runs.into_iter().zip(hints) {
                        if low > high {
                            continue;
                        }
                        *hint = seek(&self.keys, *hint, [z, y, low]);
                        let those = (*hint..self.keys.len()).take_while(|k| self.keys[*k] <= [z, y, high]);
                        // Of two cells of one row the first one finds the second.
                        let those = those.filter(|other| *row != [0, 0] || *other > one);
                        those.for_each(|other| self.join(one, other, &mut sets));
                    }
                }
            }
        }
        sets
    }
    /// The ways along z and y to the rows of cells around a cell, of two opposite ones one.
    fn rows(&self, near: i64) -> Vec<[i64; 2]> {
        let [_, y, z] = self.axes.map(|axis| axis.ways(near));
        z.flat_map(|z| y.clone().map(move |y| [z, y])).filter(|row| *row >= [0, 0]).collect()
    }
    /// Joins two cells if particles of them are a pair.
    fn join(&self, one: usize, other: usize, sets: &mut Sets) {
        let [a, b] = [one, other].map(|cell| self.starts[cell]);
        if sets.root(a) != sets.root(b) && self.touch(self.those(one), self.those(other)) {
            sets.join(a, b);
        }
    }
    fn those(&self, cell: usize) -> &[DVec3] {
        &self.places[self.starts[cell]..self.starts[cell + 1]]
    }
    /// Whether one of these and one of those are a pair.
    fn touch(&self, these: &[DVec3], those: &[DVec3]) -> bool {
        let pair =
            |a: &DVec3, b: &DVec3| self.bounds.shortest(*b - *a).length_squared() < self.distance * self.distance;
        let any = |these: &[DVec3], those: &[DVec3]| these.iter().any(|a| those.iter().any(|b| pair(a, b)));
        if these.len().saturating_mul(those.len()) <= FEW {
            return any(these, those);
        }
        let these = self.facing(these, those);
        let those = self.facing(those, &these);
        any(&these, &those)
    }
    /// Those of some particles that are within the linking length of the box around others.
    fn facing(&self, some: &[DVec3], others: &[DVec3]) -> Vec<DVec3> {
        let (low, high) = extent(others);
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        // An image of a coordinate is no nearer to any between two ends than to their middle, less half of what is between them.
        let apart = |x: &DVec3| (self.bounds.shortest(*x - middle).abs() - half).max(DVec3::ZERO).length_squared();
        some.iter().copied().filter(|x| apart(x) < self.distance * self.distance).collect()
    }
}

/// The first of ascending keys that is not below a key, sought from a place that may be near it.
fn seek(keys: &[[i64; 3]], from: usize, key: [i64; 3]) -> usize {
    let (mut low, mut high, mut step) = (from, from, 1);
    while low > 0 && keys[low - 1] >= key {
        low = low.saturating_sub(step);
        step *= 2;
    }
    step = 1;
    while high < keys.len() && keys[high] < key {
        high = keys.len().min(high + step);
        step *= 2;
    }
    low + keys[low..high].partition_point(|one| *one < key)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::Side;
    use crate::visit::random::{fraction, pcg4d};

    /// Boxes with a corner that is not at 0: periodic, open, and along one axis.
    fn boxes() -> [Bounds; 5] {
        let (low, high) = (DVec3::new(-0.4, -0.3, 0.2), DVec3::new(0.6, 0.9, 1.1));
        let solid = Bounds::new(low, high, Side::Periodic);
        let flat = Bounds::new(low.with_z(0.0), high.with_z(0.0), Side::Periodic);
        let open = |bounds: Bounds| Bounds { sides: [Side::Open; 3], ..bounds };
        let mixed = Bounds { sides: [Side::Periodic, Side::Open, Side::Reflecting], ..solid };
        [solid, flat, open(solid), open(flat), mixed]
    }
    /// Particles in a box, which are densest at its lowest corner if the power is above 1.
    fn gas(bounds: &Bounds, count: u32, seed: u32, power: i32) -> Vec<DVec3> {
        let one = |i: u32| {
            let [x, y, z, _] = pcg4d([i, seed, 0, 7]).map(|word| fraction(word).powi(power));
            bounds.low + DVec3::new(x, y, z) * (bounds.high - bounds.low)
        };
        (0..count).map(one).collect()
    }
    /// Groups by a search among all others, for each particle that is reached.
    fn by_pairs(places: &[DVec3], bounds: &Bounds, distance: f64) -> Vec<Vec<usize>> {
        let mut seen = vec![false; places.len()];
        let mut groups = Vec::new();
        while let Some(first) = seen.iter().position(|seen| !seen) {
            seen[first] = true;
            let (mut open, mut group) = (vec![first], Vec::new());
            while let Some(i) = open.pop() {
                group.push(i);
                let near = |j: &usize| bounds.shortest(places[*j] - places[i]).length() < distance;
                let found: Vec<usize> = (0..places.len()).filter(|j| !seen[*j] && near(j)).collect();
                found.iter().for_each(|j| seen[*j] = true);
                open.extend(found);
            }
            group.sort_unstable();
            groups.push(group);
        }
        groups
    }

    #[test]
    fn groups_are_those_of_all_pairs() {
        let mut several = 0;
        for bounds in boxes() {
            for (count, seed, power) in [(1, 1, 1), (2, 2, 1), (65, 3, 1), (250, 4, 1), (250, 5, 3), (250, 6, 6)] {
                let places = gas(&bounds, count, seed, power);
                for distance in [0.003, 0.02, 0.05, 0.1, 0.2, 0.35, 0.7, 1.3] {
                    let mut have = groups(&places, &bounds, distance, 1);
                    have.sort_unstable();
                    let want = by_pairs(&places, &bounds, distance);
                    assert_eq!(have, want, "{bounds}: {count} of seed {seed}, {distance}");
                    several += u32::from(want.len() > 1 && want.len() < places.len());
                    let mut large = groups(&places, &bounds, distance, 3);
                    large.sort_unstable();
                    assert!(large.iter().eq(want.iter().filter(|group| group.len() >= 3)), "three at least");
                }
            }
        }
        assert!(several > 50, "{several} of them say something");
    }
    #[test]
    fn a_pair_is_nearer_than_the_linking_length() {
        let bounds = Bounds::new(DVec3::ZERO, DVec3::splat(5.0), Side::Periodic);
        let crystal: Vec<DVec3> =
            (0..125_u32).map(|k| DVec3::from([k % 5, k / 5 % 5, k / 25].map(f64::from))).collect();
        assert_eq!(groups(&crystal, &bounds, 1.0, 1).len(), 125);
        assert_eq!(groups(&crystal, &bounds, 1.000_001, 1).len(), 1);
    }
    /// Two times 10 000 in a third of a linking length each, of which 10⁸ pairs would be tried one by one.
    #[test]
    fn clumps_are_joined_by_their_nearest_particles() {
        let clump = |seed: u32, from: f64| {
            let small = Bounds::new(DVec3::ZERO, DVec3::splat(0.3), Side::Open);
            gas(&small, 10_000, seed, 1).into_iter().map(move |x| x + DVec3::new(from, 0.0, 0.0))
        };
        // Some hundreds on each side lie so near to the faces that they are nearer than 1 to those opposite.
        for (from, want) in [(1.25, vec![20_000]), (1.35, vec![10_000; 2])] {
            let places: Vec<DVec3> = clump(1, 0.0).chain(clump(2, from)).collect();
            let sizes: Vec<usize> = groups(&places, &Bounds::default(), 1.0, 1).iter().map(Vec::len).collect();
            assert_eq!(sizes, want);
        }
    }
    #[test]
    fn what_is_too_far_away_is_in_no_group() {
        let places = [0.0, 1e30, 0.5, -1e30, 1e30, 1e6, 1e6 + 0.5].map(|x| DVec3::new(x, 0.0, 0.0));
        assert_eq!(groups(&places, &Bounds::default(), 1.0, 1), [[0, 2], [5, 6]]);
    }
    #[test]
    fn a_key_is_found_from_anywhere() {
        let keys: Vec<[i64; 3]> = [1, 1, 4, 5, 5, 5, 9].map(|x| [0, x, 0]).to_vec();
        for from in 0..=keys.len() {
            let found = [0, 1, 2, 5, 6, 9, 10].map(|x| seek(&keys, from, [0, x, 0]));
            assert_eq!(found, [0, 0, 2, 3, 6, 6, 7], "from {from}");
        }
    }
}
