//! Cross-sections of passages: the clear width between walls, across the direction of motion.

use glam::DVec2;

use crate::floor_plan::{FloorPlan, Segment};

/// Half the angle of the sectors in which walls to the left and to the right are looked for is 45°: the tangent of it.
const OPENING: f64 = 1.0;

/// No wall is nearer to the middle of a cross-section than this part of its width; half of it where walls face each other.
const CLEAR: f64 = 0.35;
/// But for rooms, of more than this \[length\].
const WIDE: f64 = 2.0;

/// A cross-section of a passage.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Passage {
    /// Its ends, on the walls to the right and to the left \[length\].
    pub ends: [DVec2; 2],
}

impl Passage {
    /// The narrowest one through a point, for motion in a direction: between the nearest points of walls within 45° of its right and of its left. None
    /// where there is no wall at a side, or both are the same corner. Within passages that is their clear width; in rooms walls before and behind may be
    /// nearer than those at the sides, and it is less than the width of the room. None without a direction, as where the way ends.
    #[must_use]
    pub fn through(plan: &FloorPlan, x: DVec2, heading: DVec2) -> Option<Self> {
        if heading == DVec2::ZERO {
            return None;
        }
        let left = heading.perp();
        let nearest = |side: DVec2| {
            let feet = plan.segments().iter().filter_map(|wall| clipped(wall, x, side));
            feet.min_by(|a, b| a.distance(x).total_cmp(&b.distance(x)))
        };
        let found = Self { ends: [nearest(-left)?, nearest(left)?] };
        // Beside a corner both may be on one wall, or on two that meet there.
        let clear = plan.distance(found.middle()) >= CLEAR * found.width().min(WIDE) && plan.holds(found.middle());
        clear.then_some(found)
    }
    /// Its width: the distance between its ends \[length\].
    #[must_use]
    pub fn width(&self) -> f64 {
        self.ends[0].distance(self.ends[1])
    }
    /// Its middle \[length\].
    #[must_use]
    pub fn middle(&self) -> DVec2 {
        0.5 * (self.ends[0] + self.ends[1])
    }
    /// Where on the way between two points it is crossed, from 0 to 1; its ends count a little into the walls, as chords of curved ways cut corners.
    #[must_use]
    pub fn crossed(&self, [a, b]: [DVec2; 2]) -> Option<f64> {
        let across = self.ends[1] - self.ends[0];
        let [before, after] = [a, b].map(|x| across.perp_dot(x - self.ends[0]));
        if before.signum() == after.signum() && after != 0.0 || (before - after).abs() < f64::MIN_POSITIVE {
            return None;
        }
        let part = before / (before - after);
        let along = (a + part * (b - a) - self.ends[0]).dot(across) / across.length_squared().max(1e-12);
        let room = 0.4 / across.length().max(0.4);
        (-room..1.0 + room).contains(&along).then_some(part)
    }
}

/// The point of a wall nearest to a place, within a sector around a side of it.
fn clipped(wall: &Segment, x: DVec2, side: DVec2) -> Option<DVec2> {
    let (a, b) = (wall.a - x, wall.b - x);
    let along = b - a;
    // |r × side| ≤ OPENING r·side, as two half planes.
    let (mut from, mut to) = (0.0_f64, 1.0_f64);
    for turn in [-1.0, 1.0] {
        let inside = |r: DVec2| OPENING * r.dot(side) + turn * side.perp_dot(r);
        let (start, slope) = (inside(a), inside(along));
        if slope == 0.0 {
            if start < 0.0 {
                return None;
            }
        } else if slope > 0.0 {
            from = from.max(-start / slope);
        } else {
            to = to.min(-start / slope);
        }
    }
    if from > to {
        return None;
    }
    let s = (-a.dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(from, to);
    Some(x + a + s * along)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::floor_plan::Polygon;

    /// A thin wall with a door from 4 to 5.2 between two rooms: next to its plane the width is that of the door, wherever in it; further off it is larger.
    #[test]
    fn the_width_of_a_door_is_that_between_its_posts() {
        let room = [
            [0.0, 0.0],
            [6.0, 0.0],
            [6.0, 4.0],
            [6.02, 4.0],
            [6.02, 0.0],
            [9.0, 0.0],
            [9.0, 9.0],
            [6.02, 9.0],
            [6.02, 5.2],
            [6.0, 5.2],
            [6.0, 9.0],
            [0.0, 9.0],
        ];
        let outline = room.map(DVec2::from_array).to_vec();
        let plan = FloorPlan::new(&[Polygon { outline, holes: Vec::new() }], Vec::new(), 0.1).expect("a plan");
        let width = |x: f64, y: f64| Passage::through(&plan, DVec2::new(x, y), DVec2::X).expect("a passage").width();
        for y in [4.1, 4.5, 5.0] {
            assert!((width(6.01, y) - 1.2).abs() < 1e-9 && (width(5.98, y) - 1.2).abs() < 1e-3, "{}", width(5.98, y));
        }
        // In a room the sector to the left sees the wall behind, too: from 2 0 to 0 4.
        assert!((width(2.0, 2.0) - 20.0_f64.sqrt()).abs() < 1e-9, "{}", width(2.0, 2.0));
        // Behind the wall by 0.98, at 45 degrees, its posts are nearer to the middle than they are apart: no passage.
        let behind = Passage::through(&plan, DVec2::new(7.0, 4.6), DVec2::X);
        assert!(behind.is_none(), "{behind:?}");
        let door = Passage::through(&plan, DVec2::new(6.01, 4.5), DVec2::X).expect("a passage");
        let beside = Passage::through(&plan, DVec2::new(5.95, 3.85), DVec2::new(0.8, 0.6));
        assert!(beside.is_none_or(|one| one.width() >= 1.2), "{beside:?}");
        // At an exit close behind a door the way ends, and nothing is to its left or right.
        assert_eq!(Passage::through(&plan, DVec2::new(6.3, 4.5), DVec2::ZERO), None);
        let part = door.crossed([DVec2::new(5.9, 4.5), DVec2::new(6.3, 4.5)]).expect("crossed");
        assert!((part - 0.275).abs() < 1e-9);
        assert!(door.crossed([DVec2::new(5.9, 6.0), DVec2::new(6.3, 6.0)]).is_none());
        assert!(door.crossed([DVec2::new(5.7, 4.5), DVec2::new(5.9, 4.5)]).is_none());
    }
}
