//! Tanks as their edges.

use glam::{DVec2, DVec3};

use super::frame::Frame;
use super::solid::{Shape, Solid};

/// Ends of an edge that is not in the picture are so far out of it.
const AWAY: f64 = -1e6;

/// Chords of a circle.
const CHORDS: u32 = 48;

/// How many edges a tank has: a rectangle 4, a box 12, a capsule two circles, and nothing else any.
pub fn number(tank: &Solid) -> u32 {
    match tank.shape {
        Shape::Box { half } if half.z == 0.0 => 4,
        Shape::Box { .. } => 12,
        Shape::Capsule { .. } => 2 * CHORDS,
        _ => 0,
    }
}

/// An edge in the picture: of both ends pixels right and down, and flat depth.
#[derive(Clone, Copy)]
pub struct Edge {
    ends: [DVec3; 2],
}

/// How much of a pixel edges cover.
#[derive(Debug, Clone, Copy, Default)]
pub struct Cover {
    pub behind: f64,
    pub before: f64,
}

/// The edges of a tank, as a frame sees them.
pub fn edges(tank: &Solid, frame: &Frame) -> Vec<Edge> {
    let half = match tank.shape {
        Shape::Box { half } => half,
        Shape::Capsule { radius, half } => return rings(tank, frame, radius, half),
        _ => return Vec::new(),
    };
    let corner = |bits: usize| {
        let side = |k: usize| if bits >> k & 1 == 1 { half[k] } else { -half[k] };
        tank.place + tank.turn * DVec3::new(side(0), side(1), side(2))
    };
    let axes = if half.z == 0.0 { 2 } else { 3 };
    let from = |low: usize| (0..axes).filter(move |axis| low >> axis & 1 == 0).map(move |axis| (low, low | 1 << axis));
    let pairs = (0..1_usize << axes).flat_map(from);
    pairs.map(|(a, b)| Edge { ends: seen(frame, corner(a), corner(b)) }).collect()
}

/// Two circles about z, at both ends.
fn rings(tank: &Solid, frame: &Frame, radius: f64, half: f64) -> Vec<Edge> {
    let at = |end: usize, chord: u32| {
        let (sine, cosine) = (std::f64::consts::TAU * f64::from(chord) / f64::from(CHORDS)).sin_cos();
        let z = if end == 0 { -half } else { half };
        tank.place + tank.turn * DVec3::new(radius * cosine, radius * sine, z)
    };
    let circles = (0..2).flat_map(|end| (0..CHORDS).map(move |chord| [(end, chord), (end, chord + 1)]));
    circles.map(|[a, b]| Edge { ends: seen(frame, at(a.0, a.1), at(b.0, b.1)) }).collect()
}

impl Edge {
    /// Its ends \[pixels\].
    #[cfg(feature = "images")]
    pub fn places(&self) -> [DVec2; 2] {
        self.ends.map(glam::DVec3::truncate)
    }
    /// What the device holds of it.
    pub fn words(&self) -> impl Iterator<Item = u32> + use<> {
        #[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is what the device does")]
        self.ends.into_iter().flat_map(|end| end.extend(0.0).to_array().map(|x| (x as f32).to_bits()))
    }
}

/// Both ends in the picture: right and down, flat depth; what is behind the eye is cut off.
fn seen(frame: &Frame, a: DVec3, b: DVec3) -> [DVec3; 2] {
    let least = 1.01 * super::frame::NEAR * frame.camera.distance;
    let depth = |x: DVec3| frame.see(x).depth;
    let (near, far) = (depth(a), depth(b));
    let cut = |from: DVec3, to: DVec3, z: f64, other: f64| {
        if frame.camera.distance == 0.0 || z >= least { from } else { from.lerp(to, (least - z) / (other - z)) }
    };
    if frame.camera.distance > 0.0 && near.max(far) <= least {
        return [DVec3::new(AWAY, AWAY, 1.0); 2];
    }
    [cut(a, b, near, far), cut(b, a, far, near)].map(|x| {
        let seen = frame.see(x);
        seen.place.extend(frame.flat_depth(seen.depth))
    })
}

/// How much of a pixel edges cover that are behind a depth and before it; behind `hidden` there is none.
pub fn cover(edges: &[Edge], frame: &Frame, place: DVec2, depth: f64, hidden: f64) -> Cover {
    let mut cover = Cover::default();
    for Edge { ends: [a, b] } in edges {
        let (off, way) = (place - a.truncate(), (*b - *a).truncate());
        let s = (off.dot(way) / way.length_squared().max(1e-6)).clamp(0.0, 1.0);
        let part = (frame.water.wire + 0.5 - (off - s * way).length()).clamp(0.0, 1.0);
        let there = frame.flat_depth(a.z + s * (b.z - a.z));
        if there < hidden {
            let side = if there < depth { &mut cover.before } else { &mut cover.behind };
            *side = side.max(part);
        }
    }
    cover
}
