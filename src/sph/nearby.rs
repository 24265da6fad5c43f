//! Nearby particles, on the host and in f64: for starts, which are looked at once.

use std::collections::HashMap;
use std::ops::Range;

use glam::DVec3;

use crate::kernel::{Bounds, Side};

/// Particles by the cells of a grid.
pub(super) struct Nearby<'a> {
    positions: &'a [DVec3],
    bounds: &'a Bounds,
    range: f64,
    /// The number of cells along a periodic axis, otherwise 0.
    around: [i64; 3],
    order: Vec<usize>,
    cells: HashMap<[i64; 3], Range<usize>>,
}

impl<'a> Nearby<'a> {
    pub(super) fn new(positions: &'a [DVec3], bounds: &'a Bounds, range: f64) -> Self {
        let period = bounds.period();
        let around = [0, 1, 2].map(|axis| match bounds.sides[axis] {
            Side::Periodic => floor(period[axis] / range).max(1),
            _ => 0,
        });
        let mut nearby = Self { positions, bounds, range, around, order: Vec::new(), cells: HashMap::new() };
        let mut cells: Vec<_> = positions.iter().map(|x| nearby.cell(*x)).zip(0..).collect();
        cells.sort_unstable();
        for (place, (cell, _)) in cells.iter().enumerate() {
            nearby.cells.entry(*cell).or_insert(place..place).end = place + 1;
        }
        nearby.order = cells.into_iter().map(|(_, id)| id).collect();
        nearby
    }
    fn cell(&self, x: DVec3) -> [i64; 3] {
        [0, 1, 2].map(|axis| {
            let of = self.around[axis];
            if of == 0 {
                return floor(x[axis] / self.range);
            }
            let part = (x[axis] - self.bounds.low[axis]) / self.bounds.period()[axis];
            floor(part * of as f64).rem_euclid(of)
        })
    }
    /// All others in range: their ids and the ways to them.
    pub(super) fn of(&self, id: usize, mut meet: impl FnMut(usize, DVec3)) {
        let x = self.positions[id];
        let home = self.cell(x);
        let steps = |axis: usize| {
            let of = self.around[axis];
            // Around three cells one has seen all there are.
            let (from, to) = match of {
                1 => (0, 0),
                2 => (-1, 0),
                _ => (-1, 1),
            };
            (from..=to).map(move |step| {
                let cell = home[axis] + step;
                if of == 0 { cell } else { cell.rem_euclid(of) }
            })
        };
        for cx in steps(0) {
            for cy in steps(1) {
                for cz in steps(2) {
                    let Some(places) = self.cells.get(&[cx, cy, cz]) else { continue };
                    for you in self.order[places.clone()].iter().filter(|you| **you != id) {
                        let r = self.bounds.shortest(self.positions[*you] - x);
                        if r.length_squared() < self.range * self.range {
                            meet(*you, r);
                        }
                    }
                }
            }
        }
    }
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "what is beyond 64 bits saturates: no particles are near each other there"
)]
fn floor(x: f64) -> i64 {
    // Neighbours of the last cell are still numbers.
    (x.floor() as i64).clamp(i64::MIN / 2, i64::MAX / 2)
}
