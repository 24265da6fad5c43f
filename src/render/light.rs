//! The lamp of a picture.

use glam::DVec3;

use super::Camera;
use super::frame::{Frame, NEVER};

/// Towards the lamp, and its own axes: right, up, towards the eye; of length 1.
pub const LAMP: DVec3 = DVec3::new(-0.48, 0.6, 0.64);
pub const LAMP_RIGHT: DVec3 = DVec3::new(0.8, 0.0, 0.6);
pub const LAMP_UP: DVec3 = DVec3::new(0.36, 0.8, -0.48);
/// What the lamp sees: half the height of it, as a part of the wider half of the picture.
pub const LAMP_VIEW: f64 = 1.4;

/// The same scene as the lamp sees it, with parallel rays.
pub fn from_lamp(frame: &Frame) -> Frame {
    let Camera { center, back, right, up, .. } = frame.camera;
    let turned = |v: DVec3| v.x * right + v.y * up + v.z * back;
    let camera = Camera {
        center,
        back: turned(LAMP),
        right: turned(LAMP_RIGHT),
        up: turned(LAMP_UP),
        extent: frame.lamp,
        distance: 0.0,
    };
    // A line is as wide as the map can hold without gaps; and a slab across the lamp's own line of sight would be another one.
    Frame { camera, width: frame.map, height: frame.map, fine: 1, thread: 0.75, slab: NEVER, ..*frame }
}
