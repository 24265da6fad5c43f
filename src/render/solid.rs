//! Solids in a picture, and where rays meet them.

use glam::{DMat3, DQuat, DVec3, DVec4};

use super::frame::{Frame, NEVER, NONE};
use crate::motion::Motion;
use crate::solids::{self, Standing};

/// A solid that stands in a picture. It is drawn, and nothing else.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Solid {
    /// What it is.
    pub shape: Shape,
    /// Its middle; of a plane any place on it \[length\].
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
}

/// Words of a solid on the device.
pub const WORDS: usize = 12;
const ROUND: u32 = 0;
const BOX: u32 = 1;
const PLANE: u32 = 2;
const THIN: f64 = 1e-9;

impl Solid {
    /// What stands in a scene, as it is at a time.
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
        };
        let motion = motions.iter().find(|motion| motion.name == standing.motion);
        let place = motion.map_or(standing.position, |motion| motion.place(standing.position, time));
        let turn = motion.map_or(own, |motion| motion.pose(time).turn * own);
        Self { shape, place, turn }
    }
    /// How far it reaches from its middle \[length\]; nothing is said of planes.
    #[must_use]
    pub fn reach(&self) -> Option<f64> {
        match self.shape {
            Shape::Ball { radius } => Some(radius),
            Shape::Capsule { radius, half } => Some(radius + half),
            Shape::Box { half } => Some(half.length()),
            Shape::Plane => None,
        }
    }
    /// What the device holds of it, in the axes of a picture.
    pub(super) fn words(&self, frame: &Frame) -> [u32; WORDS] {
        let camera = &frame.camera;
        let axes = DQuat::from_mat3(&DMat3::from_cols(camera.right, camera.up, camera.back)).inverse();
        let (place, turn) = (axes * (self.place - camera.center), axes * self.turn);
        let (radius, size, shape) = match self.shape {
            Shape::Ball { radius } => (radius, DVec3::ZERO, ROUND),
            Shape::Capsule { radius, half } => (radius, half * DVec3::Z, ROUND),
            Shape::Box { half } => (0.0, half, BOX),
            Shape::Plane => (0.0, square(camera.extent) * DVec3::X, PLANE),
        };
        #[expect(clippy::cast_possible_truncation, reason = "rounding to f32 is what the device does")]
        let bits = |x: f64| (x as f32).to_bits();
        let [p, s, t] = [place.extend(radius), size.extend(0.0), DVec4::from(turn)].map(|v| v.to_array().map(bits));
        [p[0], p[1], p[2], p[3], s[0], s[1], s[2], shape, t[0], t[1], t[2], t[3]]
    }
}

/// The squares of a floor: a few of them in the picture, and a round number long.
fn square(extent: f64) -> f64 {
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

/// A solid as the device holds it.
#[derive(Debug, Clone, Copy)]
pub struct Body {
    pub place: DVec3,
    pub turn: DQuat,
    pub size: DVec3,
    radius: f64,
    shape: u32,
}

/// Where a ray meets a solid.
#[derive(Debug, Clone, Copy)]
pub struct Meeting {
    /// How often the ray's direction it is away; [`NEVER`] when it meets none.
    pub way: f64,
    pub normal: DVec3,
    pub number: u32,
}

impl Body {
    pub fn all(words: &[u32]) -> Vec<Self> {
        let one = |w: &[u32]| {
            let x = |k: usize| f64::from(f32::from_bits(w[k]));
            let (place, size) = (DVec3::new(x(0), x(1), x(2)), DVec3::new(x(4), x(5), x(6)));
            Self { place, size, radius: x(3), shape: w[7], turn: DQuat::from_xyzw(x(8), x(9), x(10), x(11)) }
        };
        words.chunks_exact(WORDS).map(one).collect()
    }
    pub fn is_plane(&self) -> bool {
        self.shape == PLANE
    }
    /// From the picture's axes to its own. The quaternion is rounded, and no longer of length 1.
    pub fn unturned(&self, v: DVec3) -> DVec3 {
        rotated(self.turn.conjugate(), v)
    }
    fn meet(&self, o: DVec3, d: DVec3) -> Option<(f64, DVec3)> {
        match self.shape {
            ROUND => self.meet_round(o, d),
            BOX => self.meet_box(o, d),
            _ => (d.z < 0.0).then(|| (-o.z / d.z, DVec3::Z)),
        }
    }
    fn meet_round(&self, o: DVec3, d: DVec3) -> Option<(f64, DVec3)> {
        let (flat_o, flat_d) = (o.truncate(), d.truncate());
        let squared = flat_d.length_squared().max(THIN);
        let along = -flat_o.dot(flat_d) / squared;
        let rest = self.radius.powi(2) - (flat_o + along * flat_d).length_squared();
        let tube = along - (rest.max(0.0) / squared).sqrt();
        let z = o.z + tube * d.z;
        let core = z.clamp(-self.size.z, self.size.z) * DVec3::Z;
        let way =
            if z.abs() < self.size.z { (rest >= 0.0).then_some(tube)? } else { to_ball(o - core, d, self.radius)? };
        Some((way, (o + way * d - core) / self.radius))
    }
    fn meet_box(&self, o: DVec3, d: DVec3) -> Option<(f64, DVec3)> {
        let safe = DVec3::from_array(d.to_array().map(|x| if x.abs() < THIN { THIN } else { x }));
        let (middle, half) = (-o / safe, (self.size / safe).abs());
        let (enter, leave) = (middle - half, middle + half);
        let way = enter.max_element();
        let sign = |k: usize| if d[k] > 0.0 { -1.0 } else { f64::from(u8::from(d[k] < 0.0)) };
        let side = |k: usize| if enter[k] >= way { sign(k) } else { 0.0 };
        (way <= leave.min_element()).then(|| (way, DVec3::new(side(0), side(1), side(2))))
    }
}

fn rotated(q: DQuat, v: DVec3) -> DVec3 {
    let axis = q.xyz();
    v + 2.0 * axis.cross(axis.cross(v) + q.w * v)
}

fn to_ball(o: DVec3, d: DVec3, radius: f64) -> Option<f64> {
    let along = -o.dot(d) / d.length_squared();
    let rest = radius * radius - (o + along * d).length_squared();
    (rest >= 0.0).then(|| along - (rest / d.length_squared()).sqrt())
}

/// The nearest of all that is further along than `least`.
pub fn meet(bodies: &[Body], o: DVec3, d: DVec3, least: f64) -> Meeting {
    let mut best = Meeting { way: NEVER, normal: DVec3::ZERO, number: NONE };
    for (number, body) in (0..).zip(bodies) {
        let met = body.meet(body.unturned(o - body.place), body.unturned(d));
        if let Some((way, normal)) = met.filter(|(way, _)| *way > least && *way < best.way) {
            best = Meeting { way, normal: rotated(body.turn, normal), number };
        }
    }
    best
}
