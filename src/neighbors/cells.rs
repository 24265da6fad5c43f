//! A grid that is filled on the host: the reference of the device's grid, also used by measurements.

use glam::{DVec3, Vec3};
use rayon::prelude::*;

use super::Grid;
use crate::error::Error;
use crate::kernel::{Bounds, Machine, Problem, Side};

/// The number of particles in the sample for a mean.
const SAMPLE: usize = 4096;

/// Particles, sorted by cell.
pub struct Cells {
    grid: Grid,
    bounds: Bounds,
    /// Every particle's image in the box.
    pub(super) wrapped_places: Vec<Vec3>,
    /// The start of each cell's particles in `ids`; one more than there are cells.
    pub(super) starts: Vec<u32>,
    /// Ids, cell by cell, ascending in each.
    pub(super) ids: Vec<u32>,
}

impl Cells {
    /// Sorts particles into cells of a range's width, for searches on the host.
    ///
    /// # Errors
    /// [`Error::Scene`] when the range is not a positive number, or there are more particles than ids.
    pub fn new(positions: &[DVec3], bounds: Bounds, range: f64) -> Result<Self, Error> {
        let count = u32::try_from(positions.len())
            .map_err(|_| Error::Scene(format!("{} particles are more than there are ids", positions.len())))?;
        let machine = Machine::HOST;
        let grid = Grid::new(range, None, &Problem::new(count, machine).at(positions, bounds))?;
        Ok(Self::sort(&grid, bounds, positions.iter().copied(), |_| true, |_| false))
    }
    /// Sorts particles chosen by their ids, some of them after all others. A cell is computed by the device's own arithmetic, so that a
    /// particle at its edge is on the same side for both.
    pub(super) fn sort(
        grid: &Grid,
        bounds: Bounds,
        positions: impl Iterator<Item = DVec3>,
        chosen: impl Fn(usize) -> bool,
        last: impl Fn(usize) -> bool,
    ) -> Self {
        let wrapped_places: Vec<Vec3> = positions.map(|x| bounds.wrapped_single(x)).collect();
        let cells = grid.count() as usize;
        let layer = |i: usize| if last(i) { cells } else { 0 };
        let keys: Vec<usize> =
            wrapped_places.iter().enumerate().map(|(i, x)| key(grid, &bounds, *x) + layer(i)).collect();
        let mut starts = vec![0_u32; grid.bins() as usize];
        let those = || (0..keys.len()).filter(|i| chosen(*i));
        those().for_each(|i| starts[keys[i] + 1] += 1);
        for c in 1..starts.len() {
            starts[c] += starts[c - 1];
        }
        let mut next = starts.clone();
        let mut ids = vec![0; starts.last().map_or(0, |n| *n as usize)];
        for i in those() {
            ids[next[keys[i]] as usize] = u32::try_from(i).unwrap_or(u32::MAX);
            next[keys[i]] += 1;
        }
        Self { grid: grid.clone(), bounds, wrapped_places, starts, ids }
    }
    /// The mean number of other particles in the cells around a particle: the candidates of a search.
    #[must_use]
    pub fn candidates(&self) -> f64 {
        let mut total = 0_u64;
        for i in 0..self.wrapped_places.len() {
            self.rows(self.wrapped_places[i], |ids| total += ids.len() as u64);
        }
        total as f64 / self.wrapped_places.len().max(1) as f64 - 1.0
    }
    /// The maximum number of other particles within the range of a particle.
    #[must_use]
    pub fn most(&self) -> u32 {
        let number = |i: usize| {
            let mut number = 0_u32;
            self.around(i, |_| number += 1);
            number
        };
        (0..self.wrapped_places.len()).into_par_iter().map(number).max().unwrap_or(0)
    }
    /// The mean number of other particles within the range, for a sample of some thousands.
    #[must_use]
    pub fn mean(&self) -> f64 {
        let every = self.wrapped_places.len().div_ceil(SAMPLE).max(1);
        let (mut found, mut asked) = (0_u64, 0_u64);
        for i in (0..self.wrapped_places.len()).step_by(every) {
            self.around(i, |_| found += 1);
            asked += 1;
        }
        found as f64 / asked.max(1) as f64
    }
    /// Calls a function with the ids of all other particles within the range of a particle.
    pub fn around(&self, i: usize, mut call: impl FnMut(usize)) {
        let wrapped = self.wrapped_places[i];
        self.rows(wrapped, |ids| {
            for &j in ids {
                let r = (self.wrapped_places[j as usize] - wrapped).as_dvec3();
                if j as usize != i && self.bounds.within(r, self.grid.range) {
                    call(j as usize);
                }
            }
        });
    }
    /// Calls a function with the ids of each cell around a position.
    fn rows(&self, wrapped: Vec3, mut call: impl FnMut(&[u32])) {
        let [nx, ny, nz] = self.grid.cells.map(i64::from);
        let c = place(&self.grid, &self.bounds, wrapped);
        let [rx, ry, rz] = reach(&self.grid, &self.bounds, wrapped);
        // If an axis has fewer cells than a search covers, each is visited once.
        let span = |n: i64, reach: i64| if 2 * reach + 1 > n { 0..n } else { -reach..reach + 1 };
        for z in span(nz, rz) {
            for y in span(ny, ry) {
                for x in span(nx, rx) {
                    let [x, y, z] = [(c[0] + x).rem_euclid(nx), (c[1] + y).rem_euclid(ny), (c[2] + z).rem_euclid(nz)];
                    let key = usize::try_from(x + nx * (y + ny * z)).unwrap_or(0);
                    call(&self.ids[self.starts[key] as usize..self.starts[key + 1] as usize]);
                }
            }
        }
    }
}

/// The number of cells to search on each side: more, where rounding errors of positions exceed a cell's slack; see
/// `shaders/visit/near_rows.wgsl`.
fn reach(grid: &Grid, bounds: &Bounds, wrapped: Vec3) -> [i64; 3] {
    let (low, per_cell) = grid.placed(bounds);
    let away = ((wrapped - low) * per_cell).abs().to_array();
    #[expect(clippy::cast_precision_loss, reason = "a small whole number")]
    let reach = |axis: usize| {
        let fine = i64::from(grid.fine[axis]);
        match away[axis] / fine as f32 {
            ranges if ranges > 2_097_152.0 => 4 * fine,
            ranges if ranges > 8192.0 => 2 * fine,
            _ => fine,
        }
    };
    [0, 1, 2].map(reach)
}

/// The cell of a wrapped position along each axis, before folding.
fn place(grid: &Grid, bounds: &Bounds, wrapped: Vec3) -> [i64; 3] {
    const FARTHEST: f32 = 536_870_912.0;
    let (low, per_cell) = grid.placed(bounds);
    let c: Vec3 = ((wrapped - low) * per_cell).floor();
    [0, 1, 2].map(|axis| {
        #[expect(clippy::cast_precision_loss, reason = "at most 8192 along a period")]
        let last = if bounds.sides[axis] == Side::Periodic { grid.cells[axis] as f32 - 1.0 } else { FARTHEST };
        #[expect(clippy::cast_possible_truncation, reason = "clamped; a number that is none becomes 0")]
        let c = c[axis].clamp(-FARTHEST, last) as i32;
        i64::from(c)
    })
}

/// The cell of a wrapped position, folded; see `shaders/neighbors/cell.wgsl`.
fn key(grid: &Grid, bounds: &Bounds, wrapped: Vec3) -> usize {
    let [nx, ny, nz] = grid.cells.map(i64::from);
    let [x, y, z] = place(grid, bounds, wrapped);
    usize::try_from(x.rem_euclid(nx) + nx * (y.rem_euclid(ny) + ny * z.rem_euclid(nz))).unwrap_or(0)
}
