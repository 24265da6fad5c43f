//! Simple solids by their signed distances: what particles avoid, lie on, or are kept in. The reference of
//! `shaders/solids/distance.wgsl`.

use glam::{DVec2, DVec3};

/// The words for the shapes, in the order of their numbers in shaders.
pub const SHAPES: &[&str] = &["sphere", "box", "plane", "capsule"];

/// A solid in its own frame, about its middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Solid {
    /// By its radius \[length\].
    Sphere(f64),
    /// By its sides \[length\].
    Box(DVec3),
    /// A half space, by the unit vector to its free side.
    Plane(DVec3),
    /// All within a radius of a line \[length\], which is given by the vector from one end to the other \[length\].
    Capsule(DVec3, f64),
    /// The lateral surface of a cone, or a tube, without thickness: its distance is never below 0.
    Cone {
        /// From the centre of one end to the other's \[length\].
        axis: DVec3,
        /// The radius at the first end \[length\].
        radius: f64,
        /// The radius at the other end \[length\].
        end: f64,
    },
}

/// A solid with its position, for pictures.
#[derive(Debug, Clone, PartialEq)]
pub struct Standing {
    /// The solid.
    pub solid: Solid,
    /// The initial position of its centre; of a plane a point on it \[length\].
    pub position: DVec3,
    /// The name of the motion that it follows; empty if it does not move.
    pub motion: String,
    /// Whether it is a container: pictures show its edges at most, for faces would hide what is in it.
    pub inside: bool,
}

impl Solid {
    /// The gradient of the signed distance φ, a unit vector that leads straight out, and φ, below zero inside, at a way from
    /// the middle. Where all ways out are as long, one goes along x; from the line of a capsule across it and z. In 2
    /// dimensions there is no way out of a box above the plane.
    #[must_use]
    pub fn distance(self, d: DVec3, dimensions: u32) -> (DVec3, f64) {
        let round = |d: DVec3, middle: DVec3, radius: f64| (d.try_normalize().unwrap_or(middle), d.length() - radius);
        match self {
            Self::Sphere(radius) => round(d, DVec3::X, radius),
            Self::Plane(normal) => (normal, normal.dot(d)),
            Self::Capsule(axis, radius) => {
                let square = axis.length_squared();
                let along = if square > 0.0 { (d.dot(axis) / square).clamp(-0.5, 0.5) } else { 0.0 };
                let across = axis.cross(DVec3::Z).try_normalize().unwrap_or(DVec3::X);
                round(d - along * axis, across, radius)
            }
            Self::Cone { axis, radius, end } => {
                let (along, height) = (axis.normalize_or(DVec3::Z), axis.length());
                let across = d - d.dot(along) * along;
                // In the plane of the axis and the point, the surface is a segment. On the axis no direction is nearer than another.
                let out = across.normalize_or_zero();
                let from = DVec2::new(across.length() - radius, d.dot(along) + 0.5 * height);
                let way = DVec2::new(end - radius, height);
                let s = (from.dot(way) / way.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
                let left = from - s * way;
                let n = left.try_normalize().unwrap_or(DVec2::X);
                (n.x * out + n.y * along, left.length())
            }
            Self::Box(size) => {
                let half = size * 0.5;
                let depth = d.abs() - if dimensions == 2 { half.with_z(3e38) } else { half };
                let outside = depth.max(DVec3::ZERO);
                let side = DVec3::from_array(d.to_array().map(|x| if x >= 0.0 { 1.0 } else { -1.0 }));
                if let Some(normal) = outside.try_normalize() {
                    return (side * normal, outside.length());
                }
                let axis = depth.max_position();
                (DVec3::AXES[axis] * side[axis], depth[axis])
            }
        }
    }
    /// Its parameters for shaders: its radius, sides, and normal or axis; 0 where it has none.
    #[must_use]
    pub fn parts(self) -> (f64, DVec3, DVec3) {
        match self {
            Self::Sphere(radius) => (radius, DVec3::ZERO, DVec3::ZERO),
            Self::Box(size) => (0.0, size, DVec3::ZERO),
            Self::Plane(normal) => (0.0, DVec3::ZERO, normal),
            Self::Capsule(axis, radius) => (radius, DVec3::ZERO, axis),
            Self::Cone { axis, radius, end } => (radius, DVec3::new(end, 0.0, 0.0), axis),
        }
    }
    /// Its index in [`SHAPES`].
    #[must_use]
    pub fn number(self) -> u32 {
        match self {
            Self::Sphere(_) => 0,
            Self::Box(_) => 1,
            Self::Plane(_) => 2,
            Self::Capsule(..) => 3,
            Self::Cone { .. } => 4,
        }
    }
}
