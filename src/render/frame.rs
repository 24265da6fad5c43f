//! Parameters of every kernel of a picture: `Frame` in `shaders/render/frame.wgsl`, and its geometry in f64.

use std::ops::Range;

use glam::{DVec2, DVec3};

use super::{Camera, Water};
use crate::kernel::Scalar;

pub use super::fields::*;

pub const NONE: u32 = u32::MAX;
/// Further than anything.
pub const NEVER: f64 = 1e30;
pub const BINS: usize = 256;
/// So many pixels of the picture are one of the bloom, each way.
pub const SHRINK: u32 = 4;
pub const NEAR: f64 = 0.05;
const FAR_OUT: f64 = 1e6;

/// The numbers of a picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Frame {
    /// Where it is taken from.
    pub camera: Camera,
    /// Particles.
    pub count: u32,
    /// Pixels from left to right.
    pub width: u32,
    /// Pixels from top to bottom.
    pub height: u32,
    /// The largest mass \[mass\].
    pub heaviest: f64,
    /// The mean mass \[mass\].
    pub mean: f64,
    /// The radius at which the heaviest particle is drawn at least \[pixels\].
    pub marker: f64,
    /// The radius at which a ball is drawn at most \[pixels\].
    pub largest: f64,
    /// The radius from which on a particle is a ball, and below it a light \[pixels\].
    pub solid: f64,
    /// The radius of a light \[pixels\].
    pub glow: f64,
    /// How much larger balls are drawn than they are.
    pub magnified: f64,
    /// What the middle of a white light adds to the canvas.
    pub unit: f64,
    /// The speeds at the ends of the colours \[length / time\].
    pub speeds: (f64, f64),
    /// Points of all trails together.
    pub points: u32,
    /// Brightness of a night, 0 or 1; else a day, a sea or paper, 2 to 4.
    pub sky: f64,
    /// Half the width of a trail \[pixels\].
    pub line: f64,
    /// Brightness of the bloom.
    pub bloom: f64,
    /// How far the bloom reaches \[pixels of it\].
    pub reach: u32,
    /// How long ago the stroke of light of each particle begins \[time\]; zero for a light without one.
    pub tail: f64,
    /// How white the brightest lights become, as a part of all of it.
    pub bleach: f64,
    /// How far particles darken a bright sky, as a part of all of it; zero for lights in a dark one.
    pub ink: f64,
    /// Brightness of ink, for that of light.
    pub tint: f64,
    /// Samples of a pixel each way, where surfaces, lines and solids are drawn.
    pub fine: u32,
    /// Half the width of a line \[pixels\].
    pub thread: f64,
    /// How many triangles are drawn.
    pub triangles: u32,
    /// How many triangles and lines.
    pub facets: u32,
    /// How many solids.
    pub solids: u32,
    /// Half the height of what is in the map of shadows \[length\].
    pub lamp: f64,
    /// Pixels of the map of shadows, each way.
    pub map: u32,
    /// What is farther from the centre, towards the eye or away from it, is not drawn \[length\].
    pub slab: f64,
    /// What a fluid looks like.
    pub water: Water,
}

/// Where a place is seen.
pub struct Seen {
    pub place: DVec2,
    pub depth: f64,
    pub scale: f64,
    pub visible: bool,
}

impl Frame {
    /// Pixels per length, at the centre.
    pub(super) fn scale(&self) -> f64 {
        0.5 * f64::from(self.height) / self.camera.extent
    }
    pub(super) fn size(&self) -> DVec2 {
        DVec2::new(f64::from(self.width), f64::from(self.height))
    }
    /// Pixels.
    pub(super) fn area(&self) -> u32 {
        self.width * self.height
    }
    /// Samples of surfaces, lines and solids.
    pub(super) fn samples(&self) -> u32 {
        self.area() * self.fine * self.fine
    }
    /// Columns and rows of the bloom.
    pub(super) fn shrunk(&self) -> (u32, u32) {
        (self.width.div_ceil(SHRINK), self.height.div_ceil(SHRINK))
    }
    /// Pixels per length at a depth.
    pub(super) fn scale_at(&self, depth: f64) -> f64 {
        let distance = self.camera.distance;
        if distance > 0.0 { self.scale() * distance / depth } else { self.scale() }
    }
    pub(super) fn see(&self, x: DVec3) -> Seen {
        let camera = &self.camera;
        let r = x - camera.center;
        let z = r.dot(camera.back);
        let depth = camera.distance - z;
        let near = NEAR * camera.distance;
        let parallel = camera.distance == 0.0;
        let scale = if parallel { self.scale() } else { self.scale() * camera.distance / depth.max(near) };
        let place = 0.5 * self.size() + scale * DVec2::new(r.dot(camera.right), -r.dot(camera.up));
        let visible = (parallel || depth > near) && z.abs() <= self.slab && place.abs().max_element() < FAR_OUT;
        Seen { place, depth, scale, visible }
    }
    /// What is linear in the picture, and back: one over the depth where rays meet in an eye.
    pub(super) fn flat_depth(&self, depth: f64) -> f64 {
        if self.camera.distance > 0.0 { depth.recip() } else { depth }
    }
    /// Columns and rows that something between two corners may touch.
    pub(super) fn touched(&self, low: DVec2, high: DVec2) -> (Range<u32>, Range<u32>) {
        let low = low.floor().clamp(DVec2::ZERO, self.size());
        let high = high.ceil().clamp(DVec2::ZERO, self.size());
        (whole(low.x)..whole(high.x), whole(low.y)..whole(high.y))
    }
    pub(super) fn pixel(&self, x: u32, y: u32) -> usize {
        y as usize * self.width as usize + x as usize
    }
    pub(super) fn values(&self) -> Vec<(&'static str, Scalar)> {
        let camera = &self.camera;
        let float = Scalar::Float;
        let mut values = vec![
            ("center", Scalar::Vector(camera.center)),
            ("distance", float(camera.distance)),
            ("right", Scalar::Vector(camera.right)),
            ("scale", float(self.scale())),
            ("up", Scalar::Vector(camera.up)),
            ("heaviest", float(self.heaviest)),
            ("mean", float(self.mean)),
            ("back", Scalar::Vector(camera.back)),
            ("marker", float(self.marker)),
            ("width", Scalar::Uint(self.width)),
            ("height", Scalar::Uint(self.height)),
            ("largest", float(self.largest)),
            ("solid", float(self.solid)),
            ("glow", float(self.glow)),
            ("magnified", float(self.magnified)),
            ("unit", float(self.unit)),
            ("slow", float(self.speeds.0)),
            ("fast", float(self.speeds.1)),
            ("points", Scalar::Uint(self.points)),
            ("sky", float(self.sky)),
            ("line", float(self.line)),
            ("bloom", float(self.bloom)),
            ("reach", Scalar::Uint(self.reach)),
            ("tail", float(self.tail)),
            ("bleach", float(self.bleach)),
            ("ink", float(self.ink)),
            ("tint", float(self.tint)),
            ("fine", Scalar::Uint(self.fine)),
            ("thread", float(self.thread)),
            ("triangles", Scalar::Uint(self.triangles)),
            ("facets", Scalar::Uint(self.facets)),
            ("solids", Scalar::Uint(self.solids)),
            ("lamp", float(self.lamp)),
            ("map", Scalar::Uint(self.map)),
            ("slab", float(self.slab)),
        ];
        values.extend(self.water.values());
        values.extend(self.water.ends(self).values());
        values
    }
    /// Elements of the fields that do not have one for each particle.
    pub(super) fn sizes(&self) -> Vec<(&'static str, u64)> {
        let area = u64::from(self.area());
        let (columns, rows) = self.shrunk();
        vec![
            (TRAIL.name, u64::from(self.points.max(1))),
            (NOT_DRAWN.name, 2),
            (CANVAS.name, 3 * area),
            (FRONT.name, area),
            (OWNER.name, area),
            (STREAK.name, area),
            (HISTOGRAM.name, BINS as u64),
            (BLOOM.name, u64::from(columns) * u64::from(rows)),
            (BLURRED.name, u64::from(columns) * u64::from(rows)),
            (PIXELS.name, area),
            (FACET.name, 3 * u64::from(self.facets)),
            (SLOT.name, 3 * u64::from(self.facets)),
            (BROKEN_FACET.name, u64::from(self.facets)),
            (VERTEX.name, 2 * u64::from(self.count)),
            (LIT_VERTEX.name, 2 * u64::from(self.count)),
            (NEAREST.name, u64::from(self.samples())),
            (HOLDER.name, u64::from(self.samples())),
            (LIT.name, u64::from(self.map * self.map)),
            (SOLID.name, u64::from(self.solids.max(1))),
            (SCENERY.name, area),
            (EDGE.name, u64::from(self.water.edges.max(1))),
            (CREST.name, area),
            (VOLUME.name, area),
            (RIM.name, area),
            (SOURCE.name, area),
            (WALL.name, area),
            (COVER.name, 3 * area),
            (NEXT_COVER.name, 3 * area),
            (LEVEL.name, area),
            (THICKNESS.name, area),
            (DYE.name, area),
            (NEXT_LEVEL.name, area),
            (NEXT_THICKNESS.name, area),
            (NEXT_DYE.name, area),
            (WET.name, area),
        ]
    }
}

/// The middle of a pixel.
pub fn middle(x: u32, y: u32) -> DVec2 {
    DVec2::new(f64::from(x) + 0.5, f64::from(y) + 0.5)
}

/// A number that is known to be whole, not negative and below 2³².
#[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "the caller knows")]
pub fn whole(x: f64) -> u32 {
    x as u32
}

/// The nearest colour of three bytes: so a device keeps it.
pub fn rounded(color: DVec3) -> DVec3 {
    (color.clamp(DVec3::ZERO, DVec3::ONE) * 255.0).round() / 255.0
}

/// Bytes as parts of 1.
pub fn unpack(color: u32) -> DVec3 {
    let [r, g, b, _] = color.to_le_bytes();
    DVec3::new(f64::from(r), f64::from(g), f64::from(b)) / 255.0
}
