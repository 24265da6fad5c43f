//! Points of entities.

use std::f64::consts::TAU;

use glam::DVec2;

use super::groups::Object;

/// Curves have at most so many pieces in a turn.
const MOST: f64 = 360.0;

/// A line, or an area.
#[derive(Debug, Clone, Default)]
pub struct Outline {
    pub points: Vec<DVec2>,
    /// Its width, where it is drawn with one.
    pub width: f64,
    pub is_filled: bool,
}

/// How far pieces of curves may be from them.
#[derive(Debug, Clone, Copy)]
pub struct Fine(pub f64);

impl Fine {
    /// Pieces of an arc by this angle.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most a few hundred")]
    fn pieces(self, radius: f64, angle: f64) -> usize {
        let step = 2.0 * (1.0 - self.0 / radius.abs().max(self.0)).acos();
        let turn = (TAU / step).clamp(16.0, MOST);
        (turn * angle.abs() / TAU).ceil().clamp(1.0, 2.0 * MOST) as usize
    }
    /// An arc of an ellipse from one parameter to another.
    fn arc(self, centre: DVec2, axes: [DVec2; 2], [from, to]: [f64; 2]) -> Vec<DVec2> {
        let radius = axes[0].length().max(axes[1].length());
        let count = self.pieces(radius, to - from);
        let at = |k: usize| {
            let angle = from + (to - from) * k as f64 / count as f64;
            centre + angle.cos() * axes[0] + angle.sin() * axes[1]
        };
        (0..=count).map(at).collect()
    }
    /// A side of a polyline from a point to the next one; its bulge is the tangent of a quarter of the angle, to the left.
    fn side(self, a: DVec2, b: DVec2, bulge: f64, points: &mut Vec<DVec2>) {
        let angle = 4.0 * bulge.atan();
        let chord = b - a;
        if bulge == 0.0 || chord.length() == 0.0 || !angle.is_finite() {
            points.push(b);
            return;
        }
        let centre = 0.5 * (a + b) + chord.perp() * (1.0 - bulge * bulge) / (4.0 * bulge);
        let arm = a - centre;
        points.extend(self.arc(centre, [arm, arm.perp()], [0.0, angle]).into_iter().skip(1));
        // The end is exact.
        points.pop();
        points.push(b);
    }
}

/// A corner of a polyline.
#[derive(Debug, Clone, Copy, Default)]
pub struct Corner {
    pub at: DVec2,
    pub bulge: f64,
}

/// A polyline with its arcs.
pub fn polyline(corners: &[Corner], is_closed: bool, width: f64, fine: Fine) -> Outline {
    let mut points: Vec<DVec2> = corners.first().map(|corner| corner.at).into_iter().collect();
    corners.windows(2).for_each(|pair| fine.side(pair[0].at, pair[1].at, pair[0].bulge, &mut points));
    if let (true, Some(first), Some(last)) = (is_closed && corners.len() > 1, corners.first(), corners.last()) {
        fine.side(last.at, first.at, last.bulge, &mut points);
    }
    Outline { points, width, is_filled: false }
}

/// The corners of a LWPOLYLINE.
pub fn corners(entity: &Object<'_>) -> Result<Vec<Corner>, String> {
    let mut corners: Vec<Corner> = Vec::new();
    for group in &entity.groups {
        match (group.code, corners.last_mut()) {
            (10, _) => corners.push(Corner { at: DVec2::new(group.number()?, 0.0), bulge: 0.0 }),
            (20, Some(last)) => last.at.y = group.number()?,
            (42, Some(last)) => last.bulge = group.number()?,
            _ => {}
        }
    }
    Ok(corners)
}

/// A point by its codes.
fn point(entity: &Object<'_>, code: i32) -> Result<DVec2, String> {
    Ok(DVec2::new(entity.number(code)?, entity.number(code + 10)?))
}

/// What an entity draws; `None`: it is none of those that are understood.
pub fn of(entity: &Object<'_>, fine: Fine) -> Result<Option<Outline>, String> {
    let line = |points: Vec<DVec2>| Some(Outline { points, ..Outline::default() });
    Ok(match entity.kind {
        "LINE" => line(vec![point(entity, 10)?, point(entity, 11)?]),
        "CIRCLE" => {
            let radius = entity.number(40)?;
            line(fine.arc(point(entity, 10)?, [DVec2::X * radius, DVec2::Y * radius], [0.0, TAU]))
        }
        "ARC" => {
            let radius = entity.number(40)?;
            let [from, to] = [entity.number(50)?.to_radians(), entity.number(51)?.to_radians()];
            let angle = (to - from).rem_euclid(TAU);
            line(fine.arc(point(entity, 10)?, [DVec2::X * radius, DVec2::Y * radius], [from, from + angle]))
        }
        "ELLIPSE" => {
            let major = point(entity, 11)?;
            let [from, to] = [entity.number_or(41, 0.0)?, entity.number_or(42, TAU)?];
            let angle = if (to - from - TAU).abs() < 1e-9 { TAU } else { (to - from).rem_euclid(TAU) };
            line(fine.arc(point(entity, 10)?, [major, major.perp() * entity.number(40)?], [from, from + angle]))
        }
        "LWPOLYLINE" => {
            Some(polyline(&corners(entity)?, entity.has_bit(70, 1), entity.number_or(43, 0.0)?.abs(), fine))
        }
        "SOLID" | "TRACE" => {
            let mut points = vec![point(entity, 10)?, point(entity, 11)?];
            // The third and the fourth corner are the other way round; of a triangle the fourth is missing or repeated.
            if entity.text(13).is_some() {
                points.push(point(entity, 13)?);
            }
            points.push(point(entity, 12)?);
            Some(Outline { points, width: 0.0, is_filled: true })
        }
        _ => None,
    })
}
