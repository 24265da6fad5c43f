//! Light on what stands in a picture, and shadows.

use glam::{DVec2, DVec3};

use super::Camera;
use super::frame::{Frame, NEVER, key, whole};
use super::solid::{Body, meet};

pub const LAMP: DVec3 = DVec3::new(-0.48, 0.6, 0.64);
const LAMP_RIGHT: DVec3 = DVec3::new(0.8, 0.0, 0.6);
const LAMP_UP: DVec3 = DVec3::new(0.36, 0.8, -0.48);
const BIAS: f64 = 2.5;
const RIM: f64 = 4.0;
const WIDTH: f64 = 0.09;

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

/// What shadows are made of.
pub struct Lamp<'a> {
    pub bodies: &'a [Body],
    pub lit: &'a [u32],
    pub extent: f64,
    pub map: u32,
}

impl Lamp<'_> {
    /// Whether a part of the lamp is seen: 1 or 0.
    pub fn seen(&self, p: DVec3, normal: DVec3, jitter: DVec2) -> f64 {
        let map = f64::from(self.map);
        let texel = 2.0 * self.extent / map;
        let q = p + BIAS * texel * normal;
        let at = 0.5 * map + DVec2::new(q.dot(LAMP_RIGHT), -q.dot(LAMP_UP)) / texel + RIM * jitter;
        let inside = at.min_element() >= 0.0 && at.max_element() < map;
        if inside && self.lit[(whole(at.y) * self.map + whole(at.x)) as usize] < key(-q.dot(LAMP) - BIAS * texel) {
            return 0.0;
        }
        let way = LAMP + WIDTH * (jitter.x * LAMP_RIGHT + jitter.y * LAMP_UP);
        f64::from(u8::from(meet(self.bodies, q, way, 0.0).way >= NEVER))
    }
}

/// Of a surface; `view` leads to the eye.
pub fn matte(color: DVec3, normal: DVec3, view: DVec3, light: f64) -> DVec3 {
    let day = (0.8 * normal.dot(LAMP) + 0.2).max(0.0) * light;
    let shine = normal.dot((LAMP + view).normalize()).max(0.0).powi(20) * light;
    let rim = (1.0 - normal.dot(view).clamp(0.0, 1.0)).powi(4);
    color * (0.22 + 0.08 * normal.y + 0.72 * day) + 0.1 * shine + 0.08 * rim
}

/// Of a thread.
pub fn strand(color: DVec3, along: DVec3, view: DVec3, light: f64) -> DVec3 {
    let (l, v) = (along.dot(LAMP), along.dot(view));
    let day = (1.0 - l * l).max(0.0).sqrt();
    let shine = (day * (1.0 - v * v).max(0.0).sqrt() - l * v).max(0.0).powi(30);
    color * (0.25 + (0.2 + 0.45 * light) * day) + (0.1 + 0.35 * light) * shine * (0.3 + 0.7 * color)
}
