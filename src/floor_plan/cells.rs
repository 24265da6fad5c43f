//! The cells of a plan, on which ways to exits are found.

use std::collections::VecDeque;
use std::sync::Arc;

use glam::DVec2;

use super::{Exit, FloorPlan};

/// The most cells of a plan: 16 million, of which a device holds two fields and two tables of 64 MiB each.
pub const MOST_CELLS: usize = 1 << 24;

/// The four neighbours of a cell, as bits of [`Cells::open`]: to −x, +x, −y, +y.
const WEST: u32 = 1;
const EAST: u32 = 2;
const SOUTH: u32 = 4;
const NORTH: u32 = 8;
/// The bit of a cell whose centre is on the floor.
const FLOOR: u32 = 16;

/// The bit of a cell from which a way leads to an exit.
const WAY: u32 = 32;

/// What is known of a cell from which no exit is near.
const NOTHING: f32 = f32::INFINITY;

/// Within so many cells of an exit the distance to it is exact, where no wall is between.
const EXACT: f64 = 2.5;

/// Squares that cover a plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Cells {
    /// The lowest corner \[length\].
    pub low: DVec2,
    /// The side of a cell \[length\].
    pub side: f64,
    /// The number along x and y.
    pub count: [usize; 2],
    /// Of each cell, x first: 1, 2, 4 and 8 where it and the next one to −x, +x, −y, +y have their centres on the floor, and no wall is between;
    /// 16 where its centre is on the floor; 32 where a way leads from there to an exit.
    pub open: Arc<Vec<u32>>,
    known: Vec<f32>,
}

impl FloorPlan {
    fn counts(&self) -> [f64; 2] {
        let (low, high) = self.extent();
        // Two more, so that what is outside has cells all around; walls at multiples of the side then lie between cells.
        ((high - low) / self.cell() - 1e-9).ceil().to_array().map(|n| n + 2.0)
    }
    /// The number of its cells.
    #[must_use]
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked to be few")]
    pub fn cell_count(&self) -> usize {
        self.counts().map(|n| n as usize).iter().product()
    }
    pub(super) fn cells_fit(&self) -> Result<(), String> {
        let [nx, ny] = self.counts();
        #[expect(clippy::cast_precision_loss, reason = "a bound")]
        let most = MOST_CELLS as f64;
        if !(self.cell() > 0.0 && nx * ny <= most) {
            return Err(format!(
                "its cells of {} are {nx} by {ny}, and the most is {MOST_CELLS}: choose larger cells",
                self.cell()
            ));
        }
        Ok(())
    }
    /// Where walls cross the line at a height, in order: the floor is between the first and the second, and so on.
    fn crossings(&self, y: f64) -> Vec<f64> {
        let crossed = self.segments().iter().filter(|wall| (wall.a.y <= y) != (wall.b.y <= y));
        let at = |wall: &super::Segment| wall.a.x + (y - wall.a.y) / (wall.b.y - wall.a.y) * (wall.b.x - wall.a.x);
        let mut all: Vec<f64> = crossed.map(at).collect();
        all.sort_by(f64::total_cmp);
        all
    }
    /// Its cells, which are kept once they have been asked for.
    #[must_use]
    pub fn cells(&self) -> Arc<Cells> {
        self.cells.0.get_or_init(|| Arc::new(self.divided())).clone()
    }
    /// The cells with their centres on the floor from which an exit is near, with no wall between, and the distance from where pedestrians have
    /// left through it; a cell may be listed several times.
    fn near(&self, cells: &Cells, exit: &Exit) -> Vec<(usize, f64)> {
        let [nx, ny] = cells.count;
        let far = exit.reach + EXACT * cells.side;
        let mut near = Vec::new();
        for piece in exit.pieces() {
            let low = (piece[0].min(piece[1]) - far - cells.low) / cells.side;
            let high = (piece[0].max(piece[1]) + far - cells.low) / cells.side;
            for (y, _) in lines(low.y, high.y, ny) {
                for (x, _) in lines(low.x, high.x, nx) {
                    let (k, centre) = (y * nx + x, cells.centre(x, y));
                    let distance = super::wall::foot(piece[0], piece[1], centre).0.distance(centre);
                    if cells.is_floor(k) && distance <= far && self.free_way(piece, centre).is_some() {
                        near.push((k, (distance - exit.reach).max(0.0)));
                    }
                }
            }
        }
        near
    }
    /// The cells around a point that a pedestrian there sees, in the order of [`Cells::around`].
    fn seen(&self, cells: &Cells, x: DVec2) -> impl Iterator<Item = usize> {
        let nx = cells.count[0];
        cells.around(x).into_iter().filter(move |k| self.between(x, cells.centre(k % nx, k / nx)).is_none())
    }
    /// Whether a way leads from a point to an exit.
    #[must_use]
    pub fn leads_out(&self, x: DVec2) -> bool {
        let cells = self.cells();
        self.seen(&cells, x).any(|k| cells.open[k] & WAY > 0)
    }
    /// The first exit to which no way leads from any of these places, if there is one.
    #[must_use]
    pub fn without_way(&self, from: impl Iterator<Item = DVec2>) -> Option<&Exit> {
        let cells = self.cells();
        let mut reached = vec![false; cells.open.len()];
        let mut edge: Vec<usize> = Vec::new();
        for x in from {
            edge.extend(self.seen(&cells, x).filter(|k| cells.is_floor(*k)));
            while let Some(k) = edge.pop() {
                if !std::mem::replace(&mut reached[k], true) {
                    edge.extend(cells.next(k).into_iter().flatten().filter(|next| !reached[*next]));
                }
            }
        }
        self.exits().iter().find(|exit| !self.near(&cells, exit).iter().any(|(k, _)| reached[*k]))
    }
    fn divided(&self) -> Cells {
        let side = self.cell();
        let (low, high) = self.extent();
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "checked to be few")]
        let count = self.counts().map(|n| n as usize);
        #[expect(clippy::cast_precision_loss, reason = "few")]
        let half = 0.5 * side * DVec2::new(count[0] as f64, count[1] as f64);
        let [nx, ny] = count;
        let mut cells = Cells {
            low: 0.5 * (low + high) - half,
            side,
            count,
            open: Arc::new(vec![0; nx * ny]),
            known: vec![NOTHING; nx * ny],
        };
        let open = Arc::make_mut(&mut cells.open);
        for y in 0..ny {
            let crossings = self.crossings(centre(cells.low, side, 0, y).y);
            for x in 0..nx {
                let centre = centre(cells.low, side, x, y);
                let next = [(x > 0, WEST), (x + 1 < nx, EAST), (y > 0, SOUTH), (y + 1 < ny, NORTH)];
                let inside = next.iter().filter(|(is, _)| *is).fold(0, |all, (_, bit)| all | bit);
                let floor = crossings.partition_point(|at| *at <= centre.x) % 2 == 1;
                open[y * nx + x] = inside | if floor { FLOOR } else { 0 };
            }
        }
        self.segments().iter().for_each(|wall| cells.close(wall.a, wall.b));
        let floor: Vec<bool> = cells.open.iter().map(|open| open & FLOOR > 0).collect();
        for (k, open) in Arc::make_mut(&mut cells.open).iter_mut().enumerate() {
            let ways = [(WEST, k.wrapping_sub(1)), (EAST, k + 1), (SOUTH, k.wrapping_sub(nx)), (NORTH, k + nx)];
            let shut = ways.iter().filter(|(bit, next)| *open & bit > 0 && !(floor[k] && floor[*next]));
            *open &= !shut.fold(0, |all, (bit, _)| all | bit);
        }
        #[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is what the device does")]
        for (k, distance) in self.exits().iter().flat_map(|exit| self.near(&cells, exit)).collect::<Vec<_>>() {
            cells.known[k] = cells.known[k].min(distance as f32);
        }
        let steps = cells.steps();
        Arc::make_mut(&mut cells.open)
            .iter_mut()
            .zip(steps)
            .filter(|(_, steps)| steps.is_some())
            .for_each(|(open, _)| *open |= WAY);
        cells
    }
}

#[expect(clippy::cast_precision_loss, reason = "few")]
fn centre(low: DVec2, side: f64, x: usize, y: usize) -> DVec2 {
    low + side * DVec2::new(x as f64 + 0.5, y as f64 + 0.5)
}

impl Cells {
    /// The centre of a cell \[length\].
    #[must_use]
    pub fn centre(&self, x: usize, y: usize) -> DVec2 {
        centre(self.low, self.side, x, y)
    }
    /// Closes the ways between centres that a wall crosses.
    fn close(&mut self, a: DVec2, b: DVec2) {
        let [nx, ny] = self.count;
        let [a, b] = [a, b].map(|x| (x - self.low) / self.side - 0.5);
        let open = Arc::make_mut(&mut self.open);
        let mut shut = |x: Option<usize>, y: Option<usize>, bit: u32| {
            if let (Some(x), Some(y)) = (x.filter(|x| *x < nx), y.filter(|y| *y < ny)) {
                open[y * nx + x] &= !bit;
            }
        };
        for row in lines(a.y, b.y, ny) {
            let x = whole(a.x + (row.1 - a.y) / (b.y - a.y) * (b.x - a.x));
            shut(usize::try_from(x).ok(), Some(row.0), EAST);
            shut(usize::try_from(x + 1).ok(), Some(row.0), WEST);
        }
        for column in lines(a.x, b.x, nx) {
            let y = whole(a.y + (column.1 - a.x) / (b.x - a.x) * (b.y - a.y));
            shut(Some(column.0), usize::try_from(y).ok(), NORTH);
            shut(Some(column.0), usize::try_from(y + 1).ok(), SOUTH);
        }
    }
    /// Of a cell next to an exit, in front of all walls, the exact distance from where its pedestrians have left \[length\].
    #[must_use]
    pub fn known(&self, k: usize) -> Option<f64> {
        (self.known[k] < NOTHING).then(|| f64::from(self.known[k]))
    }
    /// Whether a cell is next to an exit, in front of all walls.
    #[must_use]
    pub fn reaches(&self, plan: &FloorPlan, exit: &Exit) -> bool {
        !plan.near(self, exit).is_empty()
    }
    /// The four cells whose centres are around a point.
    #[must_use]
    pub fn around(&self, x: DVec2) -> [usize; 4] {
        let [nx, ny] = self.count;
        let place = (x - self.low) / self.side - 0.5;
        #[expect(clippy::cast_precision_loss, reason = "few")]
        let most = DVec2::new(nx as f64 - 2.0, ny as f64 - 2.0);
        let first = place.floor().clamp(DVec2::ZERO, most);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to cells")]
        let corner = first.y as usize * nx + first.x as usize;
        [corner, corner + 1, corner + nx, corner + nx + 1]
    }
    /// The numbers of steps from exits to each cell, along open ways; `None` where there is no way.
    #[must_use]
    pub fn steps(&self) -> Vec<Option<u32>> {
        let mut steps: Vec<Option<u32>> = (0..self.known.len()).map(|k| self.known(k).map(|_| 0)).collect();
        let mut edge: VecDeque<usize> = (0..steps.len()).filter(|k| steps[*k].is_some()).collect();
        while let Some(k) = edge.pop_front() {
            let further = steps[k].map(|n| n + 1);
            for next in self.next(k).into_iter().flatten() {
                if steps[next].is_none() {
                    steps[next] = further;
                    edge.push_back(next);
                }
            }
        }
        steps
    }
    /// Whether the centre of a cell is on the floor.
    #[must_use]
    pub fn is_floor(&self, k: usize) -> bool {
        self.open[k] & FLOOR > 0
    }
    /// The neighbours of a cell to −x, +x, −y, +y, where both are on the floor and no wall is between.
    #[must_use]
    pub fn next(&self, k: usize) -> [Option<usize>; 4] {
        let nx = self.count[0];
        let all = [(WEST, k.wrapping_sub(1)), (EAST, k + 1), (SOUTH, k.wrapping_sub(nx)), (NORTH, k + nx)];
        all.map(|(bit, next)| (self.open[k] & bit > 0).then_some(next))
    }
}

/// The whole numbers from 0 below `most` between two numbers, the lower one included.
fn lines(a: f64, b: f64, most: usize) -> impl Iterator<Item = (usize, f64)> {
    let (low, high) = (a.min(b), a.max(b));
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, clippy::cast_precision_loss, reason = "few")]
    let [from, to] = [low, high].map(|x| x.ceil().clamp(0.0, most as f64) as usize);
    #[expect(clippy::cast_precision_loss, reason = "few")]
    let with = |n: usize| (n, n as f64);
    (from..to).map(with)
}

/// A number rounded down.
#[expect(clippy::cast_possible_truncation, reason = "few")]
fn whole(x: f64) -> i64 {
    x.floor() as i64
}
