//! Distances to exits between the centres of cells, and the ways down them.

use std::sync::Arc;

use glam::DVec2;

use crate::floor_plan::Cells;

/// Beyond this there is no way.
const FAR: f64 = 1e8;

/// The cells of a plan with their distances to the nearest exit.
#[derive(Debug, Clone)]
pub struct Ways {
    /// The cells.
    pub cells: Arc<Cells>,
    distance: Vec<f64>,
}

impl Ways {
    /// Cells with the distances that a run found (`crowds::EXIT_DISTANCE`) \[length\].
    #[must_use]
    pub fn new(cells: Arc<Cells>, distance: Vec<f64>) -> Self {
        Self { cells, distance }
    }
    /// The distance of a cell, where it has a way \[length\].
    #[must_use]
    pub fn of(&self, k: usize) -> Option<f64> {
        self.distance.get(k).copied().filter(|x| *x < FAR)
    }
    /// The centre of a cell \[length\].
    #[must_use]
    pub fn centre(&self, k: usize) -> DVec2 {
        let nx = self.cells.count[0];
        self.cells.centre(k % nx, k / nx)
    }
    /// The cell with a way whose centre is nearest to a point, among the four around it.
    #[must_use]
    pub fn cell(&self, x: DVec2) -> Option<usize> {
        let around = self.cells.around(x).into_iter().filter(|k| self.of(*k).is_some());
        around.min_by(|a, b| self.centre(*a).distance(x).total_cmp(&self.centre(*b).distance(x)))
    }
    /// The distance of a point to the nearest exit, between the centres around it that no wall keeps apart \[length\].
    #[must_use]
    pub fn at(&self, x: DVec2) -> Option<f64> {
        let nearest = self.cell(x)?;
        let beside = self.cells.next(nearest);
        let (mut sum, mut all) = (0.0, 0.0);
        for k in self.cells.around(x) {
            let Some(distance) = self.of(k) else { continue };
            let shares = |next: &Option<usize>| next.is_some_and(|next| self.cells.next(next).contains(&Some(k)));
            // A centre diagonally opposite is reached round both corners.
            let joined =
                k == nearest || beside.contains(&Some(k)) || beside.iter().filter(|next| shares(next)).count() > 1;
            if joined {
                let off = (1.0 - (x - self.centre(k)).abs() / self.cells.side).max(DVec2::ZERO);
                sum += off.x * off.y * distance;
                all += off.x * off.y;
            }
        }
        if all > 0.0 { Some(sum / all) } else { self.of(nearest) }
    }
    /// The next cell on the way of a cell to an exit: among the eight around it that with the steepest descent; none at the end.
    #[must_use]
    pub fn down(&self, k: usize) -> Option<usize> {
        let here = self.of(k)?;
        let sides = self.cells.next(k);
        let [west, east, south, north] = sides;
        let corner = |a: Option<usize>, b: Option<usize>, place: usize, other: usize| {
            let [one, two] = [self.cells.next(a?)[place], self.cells.next(b?)[other]];
            one.filter(|_| one == two)
        };
        let corners = [
            corner(west, south, 2, 0),
            corner(east, south, 2, 1),
            corner(west, north, 3, 0),
            corner(east, north, 3, 1),
        ];
        let straight = sides.into_iter().flatten().map(|next| (next, 1.0));
        let diagonal = corners.into_iter().flatten().map(|next| (next, std::f64::consts::SQRT_2));
        let falls = straight.chain(diagonal).filter_map(|(next, far)| Some((next, (here - self.of(next)?) / far)));
        falls.filter(|(_, fall)| *fall > 0.0).max_by(|a, b| a.1.total_cmp(&b.1)).map(|(next, _)| next)
    }
    /// The direction of motion in a cell: that over about half a metre of its way, or half a dozen cells.
    #[must_use]
    pub fn heading(&self, k: usize) -> DVec2 {
        let mut end = k;
        for _ in 0..6 {
            end = self.down(end).unwrap_or(end);
        }
        (self.centre(end) - self.centre(k)).normalize_or_zero()
    }
}
