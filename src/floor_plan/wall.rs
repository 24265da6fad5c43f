//! Walls: parts of outlines from one corner of a room to the next.

use glam::DVec2;

use super::ring::Ring;

/// The most segments of a plan: every pedestrian looks at each of them in each step.
pub const MOST_SEGMENTS: usize = 4096;

/// A wall ends where the outline turns towards the floor by more than this \[radians\], as in the corner of a room: there another wall begins, and
/// both push. Round corners that stick out, and along curves, a wall goes on.
const CORNER: f64 = std::f64::consts::FRAC_PI_6;

/// A straight piece of a wall, with the floor at its left.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Segment {
    /// Its start \[length\].
    pub a: DVec2,
    /// Its end \[length\].
    pub b: DVec2,
    /// The number of the wall that it is part of; those of one wall are consecutive.
    pub wall: u32,
    /// Whether its start, and its end, are corners that stick out into the floor.
    pub out: [bool; 2],
}

/// The nearest point of a wall.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Nearest {
    /// From the point to where the pedestrian is \[length\].
    pub way: DVec2,
    /// Whether that is on the side of the floor.
    pub seen: bool,
}

/// The nearest point of a segment, and where on it that is, from 0 to 1.
pub fn foot(a: DVec2, b: DVec2, x: DVec2) -> (DVec2, f64) {
    let along = b - a;
    let s = ((x - a).dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
    (a + s * along, s)
}

impl Segment {
    /// Its nearest point to a place.
    #[must_use]
    pub fn nearest(&self, x: DVec2) -> Nearest {
        let (at, s) = foot(self.a, self.b, x);
        let left = (self.b - self.a).perp_dot(x - self.a) > 0.0;
        let seen = left || s <= 0.0 && self.out[0] || s >= 1.0 && self.out[1];
        Nearest { way: x - at, seen }
    }
    /// The part of the way between two points at which it is crossed or touched, if it is, and is not along it.
    pub(super) fn cut(&self, from: DVec2, to: DVec2) -> Option<f64> {
        const NEARLY: f64 = 1e-9;
        let (way, along, start) = (to - from, self.b - self.a, self.a - from);
        let across = way.perp_dot(along);
        let (t, s) = (start.perp_dot(along) / across, start.perp_dot(way) / across);
        (across != 0.0 && (0.0..=1.0).contains(&t) && (-NEARLY..=1.0 + NEARLY).contains(&s)).then_some(t)
    }
    /// Whether it lies between two points. A way that ends on it crosses it; one that begins on it does not.
    #[must_use]
    pub fn crosses(&self, from: DVec2, to: DVec2) -> bool {
        let side = |x: DVec2| (self.b - self.a).perp_dot(x - self.a);
        let ahead = |x: DVec2| (to - from).perp_dot(x - from);
        let leaves = side(from) > 0.0 && side(to) <= 0.0 || side(from) < 0.0 && side(to) >= 0.0;
        let (one, other) = (ahead(self.a), ahead(self.b));
        leaves && (one <= 0.0 && other >= 0.0 || one >= 0.0 && other <= 0.0)
    }
}

/// The walls of outlines.
pub fn segments(rings: &[Ring]) -> Vec<Segment> {
    let mut all = Vec::new();
    let mut wall = 0;
    for ring in rings {
        let sides: Vec<[DVec2; 2]> = ring.sides().collect();
        let count = sides.len();
        // The turn at the start of each side: to the left is towards the floor.
        let turn = |k: usize| {
            let ([a, b], [c, d]) = (sides[(k + count - 1) % count], sides[k % count]);
            (b - a).perp_dot(d - c).atan2((b - a).dot(d - c))
        };
        let first = (0..count).find(|k| turn(*k) > CORNER).unwrap_or(0);
        for k in first..first + count {
            if k > first && turn(k) > CORNER {
                wall += 1;
            }
            let [a, b] = sides[k % count];
            all.push(Segment { a, b, wall, out: [turn(k) < 0.0, turn(k + 1) < 0.0] });
        }
        wall += 1;
    }
    all
}
