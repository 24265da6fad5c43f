//! Maps of a run: time lost, time spent and density, in squares.

use glam::DVec2;

use super::record::Record;
use super::ways::Ways;

/// Squares have about this side \[length\], in whole cells of the plan.
const SIDE: f64 = 0.25;
/// Densities are means over this \[time\].
const WINDOW: f64 = 5.0;

/// Time lost, time spent and density in each square of a plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Map {
    /// The lowest corner \[length\].
    pub low: DVec2,
    /// The side of a square \[length\].
    pub side: f64,
    /// The number along x and y.
    pub count: [usize; 2],
    /// The time lost in each square, x first, of all pedestrians together \[time\]; below 0 where they are pushed ahead of their desired speed.
    pub lost: Vec<f64>,
    /// The time spent in each \[time\].
    pub spent: Vec<f64>,
    /// The largest density in each: of the nine squares around it, as a mean over five seconds \[1 / length²\].
    pub density: Vec<f64>,
}

/// A part of a pedestrian's delay.
pub struct Part {
    /// The place: half of the way between two samples \[length\].
    pub place: DVec2,
    /// The time between them \[time\].
    pub spent: f64,
    /// The time that was lost \[time\].
    pub lost: f64,
    /// The time of the first of them \[time\].
    pub time: f64,
}

/// The parts of the delay of a pedestrian. Where a place has no way, as in a corner of a wall, the distance is that of the sample before.
pub fn parts(record: &Record, ways: &Ways, i: usize) -> Vec<Part> {
    let start = record.tracks[i].first().and_then(|x| ways.at(x.as_dvec2()));
    let mut far = start.unwrap_or(0.0);
    let part = |piece: super::record::Piece| {
        let [a, b] = piece.ends;
        let next = if piece.leaves { 0.0 } else { ways.at(b).unwrap_or(far) };
        let spent = piece.times[1] - piece.times[0];
        let lost = spent - (far - next) / record.speeds[i];
        far = next;
        Part { place: 0.5 * (a + b), spent, lost, time: piece.times[0] }
    };
    record.pieces(i).map(part).collect()
}

impl Map {
    /// The map of a run, and the square of each part of each delay.
    #[must_use]
    pub fn of(ways: &Ways, all: &[Vec<Part>]) -> Self {
        let cells = &ways.cells;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a few cells")]
        let whole = (SIDE / cells.side).round().max(1.0) as usize;
        let (side, count) = (whole as f64 * cells.side, cells.count.map(|n| n.div_ceil(whole)));
        let squares = count[0] * count[1];
        let mut map = Self {
            low: cells.low,
            side,
            count,
            lost: vec![0.0; squares],
            spent: vec![0.0; squares],
            density: vec![0.0; squares],
        };
        let mut floor = vec![0.0; squares];
        for k in (0..cells.open.len()).filter(|k| ways.of(*k).is_some()) {
            floor[map.square(ways.centre(k))] += cells.side * cells.side;
        }
        let end = all.iter().flatten().map(|part| part.time).fold(0.0, f64::max);
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "windows of a run")]
        let window = |time: f64| (time / WINDOW).max(0.0) as usize;
        let mut windows: Vec<Vec<(usize, f64)>> = vec![Vec::new(); window(end) + 1];
        for part in all.iter().flatten() {
            let at = map.square(part.place);
            map.lost[at] += part.lost;
            map.spent[at] += part.spent;
            windows[window(part.time)].push((at, part.spent));
        }
        for window in windows {
            map.crowd(&window, &floor);
        }
        map
    }
    /// Takes in the densities of a window of time.
    fn crowd(&mut self, window: &[(usize, f64)], floor: &[f64]) {
        let mut spent = vec![0.0; floor.len()];
        window.iter().for_each(|(at, time)| spent[*at] += time);
        let [nx, ny] = self.count;
        for k in (0..floor.len()).filter(|k| floor[*k] > 0.0) {
            let (x, y) = (k % nx, k / nx);
            let (mut time, mut area) = (0.0, 0.0);
            for y in y.saturating_sub(1)..(y + 2).min(ny) {
                for x in x.saturating_sub(1)..(x + 2).min(nx) {
                    time += spent[y * nx + x];
                    area += floor[y * nx + x];
                }
            }
            self.density[k] = self.density[k].max(time / (WINDOW * area));
        }
    }
    /// The square of a place; the nearest one for places outside.
    #[must_use]
    pub fn square(&self, x: DVec2) -> usize {
        let place = (x - self.low) / self.side;
        let [nx, ny] = self.count;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "clamped to squares")]
        let index = |x: f64, most: usize| (x.max(0.0) as usize).min(most - 1);
        index(place.y, ny) * nx + index(place.x, nx)
    }
    /// The lowest corner of a square \[length\].
    #[must_use]
    pub fn corner(&self, k: usize) -> DVec2 {
        self.low + self.side * DVec2::new((k % self.count[0]) as f64, (k / self.count[0]) as f64)
    }
    /// The time lost and the time spent in the nine squares around one \[time\].
    #[must_use]
    pub fn around(&self, k: usize) -> [f64; 2] {
        let [nx, ny] = self.count;
        let (x, y) = (k % nx, k / nx);
        let rows = y.saturating_sub(1)..(y + 2).min(ny);
        let all = rows.flat_map(|y| (x.saturating_sub(1)..(x + 2).min(nx)).map(move |x| y * nx + x));
        all.fold([0.0, 0.0], |[lost, spent], k| [lost + self.lost[k], spent + self.spent[k]])
    }
    /// The time lost in all squares together \[time\].
    #[must_use]
    pub fn total(&self) -> f64 {
        self.lost.iter().sum()
    }
}
