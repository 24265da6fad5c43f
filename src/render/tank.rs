//! Tanks as their edges.

use glam::{DVec2, DVec3, DVec4};

use super::frame::{Frame, key};
use super::solid::{Shape, Solid};

/// Ends of an edge that is not in the picture are so far out of it.
const AWAY: f64 = -1e6;

/// How many edges a tank has: a rectangle 4, a box 12, and nothing else any.
pub fn number(tank: &Solid) -> u32 {
    match tank.shape {
        Shape::Box { half } if half.z == 0.0 => 4,
        Shape::Box { .. } => 12,
        _ => 0,
    }
}

/// What the device holds of the edges of a tank, as a frame sees them.
pub fn words(tank: &Solid, frame: &Frame) -> Vec<u32> {
    let Shape::Box { half } = tank.shape else { return Vec::new() };
    let corner = |bits: usize| {
        let side = |k: usize| if bits >> k & 1 == 1 { half[k] } else { -half[k] };
        tank.place + tank.turn * DVec3::new(side(0), side(1), side(2))
    };
    let axes = if half.z == 0.0 { 2 } else { 3 };
    let mut ends = Vec::new();
    for low in 0..1_usize << axes {
        for axis in (0..axes).filter(|axis| low >> axis & 1 == 0) {
            ends.extend(seen(frame, corner(low), corner(low | 1 << axis)));
        }
    }
    #[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is what the device does")]
    let bits = |end: DVec4| end.to_array().map(|x| (x as f32).to_bits());
    ends.into_iter().flat_map(bits).collect()
}

/// Both ends in the picture: right and down, flat depth; what is behind the eye is cut off.
fn seen(frame: &Frame, a: DVec3, b: DVec3) -> [DVec4; 2] {
    let least = 1.01 * super::frame::NEAR * frame.camera.distance;
    let depth = |x: DVec3| frame.see(x).depth;
    let (near, far) = (depth(a), depth(b));
    let cut = |from: DVec3, to: DVec3, z: f64, other: f64| {
        if frame.camera.distance == 0.0 || z >= least { from } else { from.lerp(to, (least - z) / (other - z)) }
    };
    if frame.camera.distance > 0.0 && near.max(far) <= least {
        return [DVec4::new(AWAY, AWAY, 1.0, 0.0); 2];
    }
    [cut(a, b, near, far), cut(b, a, far, near)].map(|x| {
        let seen = frame.see(x);
        DVec4::new(seen.place.x, seen.place.y, frame.flat_depth(seen.depth), 0.0)
    })
}

/// An edge as the device holds it.
pub struct Edge {
    ends: [DVec4; 2],
}

/// All edges.
pub fn edges(ends: &[DVec4]) -> Vec<Edge> {
    ends.chunks_exact(2).map(|pair| Edge { ends: [pair[0], pair[1]] }).collect()
}

impl Edge {
    /// How much of a pixel they cover, behind of a depth and before it.
    pub fn cover(all: &[Self], frame: &Frame, place: DVec2, depth: f64, hidden: u32) -> DVec2 {
        let mut cover = DVec2::ZERO;
        for edge in all {
            let [a, b] = edge.ends;
            let (off, way) = (place - a.truncate().truncate(), (b - a).truncate().truncate());
            let s = (off.dot(way) / way.length_squared().max(1e-6)).clamp(0.0, 1.0);
            let part = (frame.water.wire + 0.5 - (off - s * way).length()).clamp(0.0, 1.0);
            let there = frame.flat_depth(a.z + s * (b.z - a.z));
            if key(there) < hidden {
                cover = cover.max(if there < depth { DVec2::new(0.0, part) } else { DVec2::new(part, 0.0) });
            }
        }
        cover
    }
}
