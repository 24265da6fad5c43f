//! What is behind the particles.

use glam::{DVec2, DVec3};

use super::frame::Frame;

const SLATE: DVec3 = DVec3::new(0.26, 0.31, 0.47);
const ROSE: DVec3 = DVec3::new(0.76, 0.55, 0.58);
const AMBER: DVec3 = DVec3::new(0.94, 0.68, 0.46);
const SUN: DVec3 = DVec3::new(0.10, 0.09, 0.01);

const ZENITH: DVec3 = DVec3::new(0.60, 0.72, 0.86);
const HAZE: DVec3 = DVec3::new(0.93, 0.94, 0.95);

/// The sky at a place in the picture.
pub fn background(frame: &Frame, place: DVec2) -> DVec3 {
    let size = frame.size();
    if frame.ink == 0.0 {
        frame.sky * night(place, size)
    } else if frame.sky > 1.0 {
        day(place, size)
    } else {
        dusk(place, size)
    }
}

fn day(place: DVec2, size: DVec2) -> DVec3 {
    ZENITH.lerp(HAZE, smooth(0.0, 0.8, place.y / size.y))
}

fn night(place: DVec2, size: DVec2) -> DVec3 {
    let off = place / size - 0.5;
    let (inner, outer) = (DVec3::new(0.036, 0.043, 0.072), DVec3::new(0.008, 0.009, 0.018));
    inner.lerp(outer, (2.0 * off.length_squared()).clamp(0.0, 1.0))
}

fn dusk(place: DVec2, size: DVec2) -> DVec3 {
    let fall = place.y / size.y;
    let air = SLATE.lerp(ROSE, smooth(0.0, 0.7, fall)).lerp(AMBER, smooth(0.5, 1.0, fall));
    let off = (place - size * DVec2::new(0.62, 1.04)) / (0.42 * size.y);
    air + SUN * (-off.length_squared()).exp2()
}

/// A step from 0 to 1, without an edge.
fn smooth(low: f64, high: f64, x: f64) -> f64 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
