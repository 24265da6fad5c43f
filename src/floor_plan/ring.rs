//! Outlines: closed lines that do not cross themselves or each other.

use glam::DVec2;

/// An outline with the floor at its left.
#[derive(Debug, Clone, PartialEq)]
pub struct Ring {
    /// What messages call it.
    pub name: String,
    /// Its points, each once.
    pub points: Vec<DVec2>,
    /// Whether it is that of a hole.
    pub hole: bool,
}

/// The area inside of points; below 0 where they go round clockwise.
fn area(points: &[DVec2]) -> f64 {
    let pairs = points.iter().zip(points.iter().cycle().skip(1));
    // From a point of it, so that a small outline far from the origin keeps its digits.
    let origin = points.first().copied().unwrap_or_default();
    pairs.map(|(a, b)| 0.5 * (a - origin).perp_dot(*b - origin)).sum()
}

impl Ring {
    /// An outline of a floor, or of a hole in it.
    pub fn new(points: &[DVec2], hole: bool, name: &str) -> Result<Self, String> {
        let single = |x: f64| x.abs() <= f64::from(f32::MAX);
        if let Some(bad) = points.iter().find(|x| !(single(x.x) && single(x.y))) {
            return Err(format!(
                "{name} has the point {} {}, which is not finite or beyond single precision",
                bad.x, bad.y
            ));
        }
        let mut points = points.to_vec();
        points.dedup();
        while points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        if points.len() < 3 {
            return Err(format!("{name} has {} different points, and an outline needs three", points.len()));
        }
        let area = area(&points);
        if area == 0.0 {
            return Err(format!("{name} has no area"));
        }
        if (area > 0.0) == hole {
            points.reverse();
        }
        Ok(Self { name: name.to_owned(), points, hole })
    }
    /// The area inside of it.
    pub fn area(&self) -> f64 {
        area(&self.points).abs()
    }
    /// Its sides.
    pub fn sides(&self) -> impl Iterator<Item = [DVec2; 2]> + '_ {
        self.points.iter().copied().zip(self.points.iter().copied().cycle().skip(1)).map(|(a, b)| [a, b])
    }
    /// Whether a point is inside, by the sides that a ray along x crosses.
    pub fn holds(&self, x: DVec2) -> bool {
        let crossed =
            |[a, b]: &[DVec2; 2]| (a.y <= x.y) != (b.y <= x.y) && x.x < a.x + (x.y - a.y) / (b.y - a.y) * (b.x - a.x);
        self.sides().filter(crossed).count() % 2 == 1
    }
}

/// Refuses outlines that cross or touch themselves or each other. Sides are sorted by x, so that distant ones are not compared.
pub fn apart(rings: &[Ring]) -> Result<(), String> {
    let mut sides = Vec::new();
    for (ring, place) in rings.iter().zip(0..) {
        let count = ring.points.len();
        sides.extend(ring.sides().enumerate().map(|(side, ends)| Side { ends, ring: place, number: side, count }));
    }
    sides.sort_by(|a, b| a.low().total_cmp(&b.low()));
    for (k, one) in sides.iter().enumerate() {
        for other in sides[k + 1..].iter().take_while(|other| other.low() <= one.high()) {
            if let Some(at) = one.meets(other) {
                let [a, b] = [one, other].map(|side| &rings[side.ring].name);
                let what = if one.ring == other.ring {
                    format!("{a} crosses or touches itself")
                } else {
                    format!("{a} and {b} cross or touch")
                };
                return Err(format!("{what} at {} {}: keep outlines apart", at.x, at.y));
            }
        }
    }
    Ok(())
}

/// A side of an outline.
struct Side {
    ends: [DVec2; 2],
    ring: usize,
    number: usize,
    count: usize,
}

impl Side {
    fn low(&self) -> f64 {
        self.ends[0].x.min(self.ends[1].x)
    }
    fn high(&self) -> f64 {
        self.ends[0].x.max(self.ends[1].x)
    }
    /// Where two sides meet that are not neighbours, or neighbours that go back on each other.
    fn meets(&self, other: &Self) -> Option<DVec2> {
        let ([a, b], [c, d]) = (self.ends, other.ends);
        let next = |one: &Self, other: &Self| one.ring == other.ring && (one.number + 1) % one.count == other.number;
        if next(self, other) || next(other, self) {
            let (before, after) = if next(self, other) { (b - a, d - c) } else { (d - c, b - a) };
            let corner = if next(self, other) { b } else { a };
            return (before.perp_dot(after) == 0.0 && before.dot(after) < 0.0).then_some(corner);
        }
        let turn = |a: DVec2, b: DVec2, c: DVec2| (b - a).perp_dot(c - a);
        let (t1, t2, t3, t4) = (turn(a, b, c), turn(a, b, d), turn(c, d, a), turn(c, d, b));
        if t1 == 0.0 && t2 == 0.0 {
            let along = |x: DVec2| (x - a).dot(b - a) / (b - a).length_squared();
            let [from, to] = if along(c) < along(d) { [c, d] } else { [d, c] };
            return (along(to) >= 0.0 && along(from) <= 1.0).then_some(if along(from) >= 0.0 { from } else { a });
        }
        let across = (t1 <= 0.0) != (t2 < 0.0) || t1 == 0.0 || t2 == 0.0;
        let through = (t3 <= 0.0) != (t4 < 0.0) || t3 == 0.0 || t4 == 0.0;
        let meets = across && through && t1 * t2 <= 0.0 && t3 * t4 <= 0.0;
        meets.then(|| a + (b - a) * (t3 / (t3 - t4)))
    }
}
