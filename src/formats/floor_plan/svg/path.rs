//! Outlines of paths on a grid.

use glam::DVec2;
use usvg::tiny_skia_path::{LineCap, Path, PathSegment, Point, Transform};

use super::super::canvas::Ink;

/// How far pieces of curves may be from them \[pixels\].
const FINE: f64 = 0.1;
/// Pieces of a curve, at most.
const MOST: f64 = 200.0;
/// Points of a dashed line, at most.
const DASHES: f64 = 10_000.0;

/// The outlines of a path, in pixels.
pub fn outlines(path: &Path, transform: Transform) -> Vec<Vec<DVec2>> {
    let place = |point: Point| {
        let mut point = point;
        transform.map_point(&mut point);
        DVec2::new(f64::from(point.x), f64::from(point.y))
    };
    let mut all: Vec<Vec<DVec2>> = Vec::new();
    for segment in path.segments() {
        let from = all.last().and_then(|last| last.last()).copied().unwrap_or_default();
        let Some(last) = all.last_mut().filter(|_| !matches!(segment, PathSegment::MoveTo(_))) else {
            if let PathSegment::MoveTo(to) = segment {
                all.push(vec![place(to)]);
            }
            continue;
        };
        match segment {
            PathSegment::LineTo(to) => last.push(place(to)),
            PathSegment::QuadTo(a, to) => {
                let [a, to] = [place(a), place(to)];
                let off = (from - 2.0 * a + to).length() / 4.0;
                curve(off, last, |t| from.lerp(a, t).lerp(a.lerp(to, t), t));
            }
            PathSegment::CubicTo(a, b, to) => {
                let [a, b, to] = [place(a), place(b), place(to)];
                let off = 0.75 * (from - 2.0 * a + b).length().max((a - 2.0 * b + to).length());
                curve(off, last, |t| {
                    let [p, q, r] = [from.lerp(a, t), a.lerp(b, t), b.lerp(to, t)];
                    p.lerp(q, t).lerp(q.lerp(r, t), t)
                });
            }
            PathSegment::MoveTo(_) | PathSegment::Close => {}
        }
    }
    all
}

/// Points of a curve that is so far off its chord, at most.
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "at most 200")]
fn curve(off: f64, points: &mut Vec<DVec2>, at: impl Fn(f64) -> DVec2) {
    // The error of n pieces is that of one over n².
    let count = (off / FINE).sqrt().ceil().clamp(1.0, MOST) as usize;
    points.extend((1..=count).map(|k| at(k as f64 / count as f64)));
}

/// The outlines of a stroke, in pixels. It is at least as wide as lines of this ink are.
#[expect(clippy::cast_possible_truncation, reason = "in single precision, as the path")]
pub fn stroke(path: &Path, stroke: &usvg::Stroke, transform: Transform, ink: Ink) -> Option<Vec<Vec<DVec2>>> {
    let (x, y) = transform.get_scale();
    let scale = x.min(y);
    if !(scale.is_finite() && scale > 0.0) {
        return None;
    }
    let mut line = stroke.to_tiny_skia();
    let narrowest = ink.narrowest() as f32 / scale;
    if line.width < narrowest {
        line.width = narrowest;
        line.line_cap = LineCap::Square;
    }
    let around = path.bounds();
    let longest = f64::from(around.width()) + f64::from(around.height());
    let dash = line.dash.take();
    let dashed = dash.filter(|_| {
        let period: f32 = stroke.dasharray().unwrap_or_default().iter().sum();
        longest / f64::from(period) * (path.len() as f64) < DASHES
    });
    let dashed = dashed.and_then(|dash| path.dash(&dash, x.max(y)));
    let outline = dashed.as_ref().unwrap_or(path).stroke(&line, x.max(y))?;
    Some(outlines(&outline, transform))
}
