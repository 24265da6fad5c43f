//! Exits: lines on the floor that pedestrians leave at.

use glam::DVec2;

use super::{FloorPlan, wall::foot};
use crate::life::Drain;
use crate::solids::Solid;

/// The most pieces of all exits together: each is a drain of its own, in every step.
pub const MOST_PIECES: usize = 256;

/// Points no farther apart are repeated \[length\]: in single precision there is no direction between them.
const SHORTEST: f64 = 1e-9;

/// Lines may leave the floor by this part of a cell, where they end at a wall: numbers in files are rounded.
const ROUNDING: f64 = 1e-4;

/// An exit: a line that pedestrians leave at, where no wall is between.
#[derive(Debug, Clone, PartialEq)]
pub struct Exit {
    /// Its name.
    pub name: String,
    /// The points of the line, two or more \[length\].
    pub path: Vec<DVec2>,
    /// The distance from the line at which a pedestrian has left \[length\].
    pub reach: f64,
}

impl Exit {
    /// The distance of a point from the line \[length\].
    #[must_use]
    pub fn distance(&self, x: DVec2) -> f64 {
        self.pieces().map(|[a, b]| (x - foot(a, b, x).0).length()).fold(f64::INFINITY, f64::min)
    }
    /// Its length \[length\].
    #[must_use]
    pub fn width(&self) -> f64 {
        self.pieces().map(|[a, b]| (b - a).length()).sum()
    }
    /// The pieces of the line, without those of repeated points.
    pub fn pieces(&self) -> impl Iterator<Item = [DVec2; 2]> + '_ {
        self.path.windows(2).map(|pair| [pair[0], pair[1]]).filter(|[a, b]| a.distance(*b) > SHORTEST)
    }
}

impl FloorPlan {
    /// The drains at its exits, which remove pedestrians that have left. They act where no wall of the plan is between.
    #[must_use]
    pub fn drains(&self) -> Vec<Drain> {
        let drain = |exit: &Exit, [a, b]: [DVec2; 2]| Drain {
            solid: Solid::Capsule((b - a).extend(0.0), exit.reach),
            position: (0.5 * (a + b)).extend(0.0),
            outside: false,
            species: None,
        };
        self.exits().iter().flat_map(|exit| exit.pieces().map(move |piece| drain(exit, piece))).collect()
    }
    /// The distance of a point from an exit's line, along the shortest free way to one of its pieces; `None` where walls are before all of them.
    #[must_use]
    pub fn free_distance(&self, exit: &Exit, x: DVec2) -> Option<f64> {
        let ways = exit.pieces().filter_map(|piece| self.free_way(piece, x));
        ways.min_by(f64::total_cmp)
    }
    /// The distance of a point from a piece of an exit, if no wall is between. A line may end at a wall, and be behind it by rounding.
    pub(super) fn free_way(&self, [a, b]: [DVec2; 2], x: DVec2) -> Option<f64> {
        let foot = foot(a, b, x).0;
        self.between(foot.lerp(x, AHEAD), x).is_none().then(|| (x - foot).length())
    }
    /// Refuses exits without length, that leave the floor, or with too many pieces.
    pub(super) fn exits_fit(&self) -> Result<(), String> {
        let pieces: usize = self.exits().iter().map(|exit| exit.pieces().count()).sum();
        if pieces > MOST_PIECES {
            return Err(format!(
                "its exits have {pieces} straight pieces, and the most is {MOST_PIECES}: draw them with fewer points"
            ));
        }
        self.exits().iter().try_for_each(|exit| self.fits(exit))
    }
    fn fits(&self, exit: &Exit) -> Result<(), String> {
        let name = &exit.name;
        if let Some(bad) = exit.path.iter().find(|x| !x.is_finite()) {
            return Err(format!("the exit \"{name}\" has the point {} {}, which is not finite", bad.x, bad.y));
        }
        if !(exit.reach > 0.0 && exit.reach.is_finite()) {
            return Err(format!("the exit \"{name}\" has the reach {}, and it must be a length above 0", exit.reach));
        }
        if exit.path.len() < 2 || exit.width() <= 0.0 {
            return Err(format!("the exit \"{name}\" has no length: it needs two points at least"));
        }
        exit.pieces().try_for_each(|piece| self.stays(name, piece))
    }
    /// Refuses a piece of an exit of which a part is off the floor, or along a wall.
    fn stays(&self, name: &str, [a, b]: [DVec2; 2]) -> Result<(), String> {
        let length = (b - a).length();
        let mut cuts: Vec<f64> = self.segments().iter().filter_map(|wall| wall.cut(a, b)).collect();
        cuts.extend([0.0, 1.0]);
        cuts.sort_by(f64::total_cmp);
        let least = ROUNDING * self.cell();
        let parts = cuts.windows(2).filter(|part| (part[1] - part[0]) * length > least);
        for (part, number) in parts.zip(0..) {
            let middle = a.lerp(b, 0.5 * (part[0] + part[1]));
            if self.holds(middle) && self.distance(middle) > 0.0 {
                continue;
            }
            if number == 0 {
                return Err(format!(
                    "the exit \"{name}\" is not on the floor at {} {}: draw its line inside of the POLYGON, where pedestrians are to leave",
                    middle.x, middle.y
                ));
            }
            let at = (1e6 * a.lerp(b, part[0])).round() / 1e6;
            return Err(format!(
                "the exit \"{name}\" crosses a wall at {} {}: end its line there, and draw an exit of its own for what is behind",
                at.x, at.y
            ));
        }
        Ok(())
    }
}

/// The part of the way from an exit's line to a pedestrian that is not asked for walls: the line may end at one.
pub const AHEAD: f64 = 1.0 / 64.0;
