//! Obstacles in a picture, and their intersections with rays.

use glam::{DMat3, DQuat, DVec3, DVec4};

use super::Camera;
use super::frame::Frame;
use crate::motion::Motion;
use crate::solids::{self, Standing};

/// A solid in a picture, for drawing only.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solid {
    /// Its shape.
    pub shape: Shape,
    /// Its centre; of a plane any point on it \[length\].
    pub place: DVec3,
    /// From its own axes to the scene's.
    pub turn: DQuat,
}

/// The shape of a solid, about its middle and along its own axes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Shape {
    /// All within a radius.
    Ball {
        /// \[length\]
        radius: f64,
    },
    /// All within a radius of a segment along z.
    Capsule {
        /// \[length\]
        radius: f64,
        /// Half the segment \[length\].
        half: f64,
    },
    /// A box.
    Box {
        /// Half of each side \[length\].
        half: DVec3,
    },
    /// All below z = 0: a floor.
    Plane,
    /// The surface of a cone about z, cut open towards the eye.
    Cone {
        /// The radius at the lower end \[length\].
        radius: f64,
        /// The radius at the upper end \[length\].
        end: f64,
        /// Half the height \[length\].
        half: f64,
    },
}

/// Words of a solid on the device.
pub const WORDS: usize = 12;
const ROUND: u32 = 0;
const BOX: u32 = 1;
const PLANE: u32 = 2;
const CONE: u32 = 3;

impl Solid {
    /// A solid of a scene, at its position at a time.
    #[must_use]
    pub fn at(standing: &Standing, motions: &[Motion], time: f64) -> Self {
        let (shape, own) = match standing.solid {
            solids::Solid::Sphere(radius) => (Shape::Ball { radius }, DQuat::IDENTITY),
            solids::Solid::Box(sides) => (Shape::Box { half: 0.5 * sides }, DQuat::IDENTITY),
            solids::Solid::Plane(normal) => (Shape::Plane, DQuat::from_rotation_arc(DVec3::Z, normal)),
            solids::Solid::Capsule(axis, radius) => {
                let along = axis.try_normalize().unwrap_or(DVec3::Z);
                (Shape::Capsule { radius, half: 0.5 * axis.length() }, DQuat::from_rotation_arc(DVec3::Z, along))
            }
            solids::Solid::Cone { axis, radius, end } => {
                let along = axis.try_normalize().unwrap_or(DVec3::Z);
                (Shape::Cone { radius, end, half: 0.5 * axis.length() }, DQuat::from_rotation_arc(DVec3::Z, along))
            }
        };
        let motion = motions.iter().find(|motion| motion.name == standing.motion);
        let place = motion.map_or(standing.position, |motion| motion.place(standing.position, time));
        let turn = motion.map_or(own, |motion| motion.pose(time).turn * own);
        Self { shape, place, turn }
    }
    /// Its radius about its centre \[length\]; `None` for planes.
    #[must_use]
    pub fn reach(&self) -> Option<f64> {
        match self.shape {
            Shape::Ball { radius } => Some(radius),
            Shape::Capsule { radius, half } => Some(radius + half),
            Shape::Box { half } => Some(half.length()),
            Shape::Plane => None,
            Shape::Cone { radius, end, half } => Some(half.hypot(radius.max(end))),
        }
    }
    /// The same in the axes of a camera, about its centre.
    pub(super) fn seen_by(&self, camera: &Camera) -> Self {
        let axes = DQuat::from_mat3(&DMat3::from_cols(camera.right, camera.up, camera.back)).inverse();
        Self { place: axes * (self.place - camera.center), turn: axes * self.turn, ..*self }
    }
    /// Its words for the device, in the axes of a picture.
    pub(super) fn words(&self, frame: &Frame) -> [u32; WORDS] {
        let camera = &frame.camera;
        let Self { place, turn, .. } = self.seen_by(camera);
        let (radius, size, shape) = match self.shape {
            Shape::Ball { radius } => (radius, DVec3::ZERO, ROUND),
            Shape::Capsule { radius, half } => (radius, half * DVec3::Z, ROUND),
            Shape::Box { half } => (0.0, half, BOX),
            Shape::Plane => (0.0, square_of(camera.extent) * DVec3::X, PLANE),
            Shape::Cone { radius, end, half } => (radius, DVec3::new(end, 0.0, half), CONE),
        };
        #[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is what the device does")]
        let bits = |x: f64| (x as f32).to_bits();
        let [p, s, t] = [place.extend(radius), size.extend(0.0), DVec4::from(turn)].map(|v| v.to_array().map(bits));
        [p[0], p[1], p[2], p[3], s[0], s[1], s[2], shape, t[0], t[1], t[2], t[3]]
    }
}

/// The side of the squares of a floor: a few of them in the picture, and a round number long.
pub fn square_of(extent: f64) -> f64 {
    let decade = 10f64.powf(extent.log10().floor());
    decade
        * if extent < 2.0 * decade {
            0.25
        } else if extent < 5.0 * decade {
            0.5
        } else {
            1.0
        }
}
