//! Triangles and lines at the samples of a picture: the nearest, and its depth.

use glam::{DVec2, DVec3, DVec4};

use super::super::frame::{Frame, NEVER, NONE, middle, whole};
use super::super::scenery::Facets;

/// Neighbours share their edge: a sample on it belongs to both, whatever is rounded.
const SLACK: f64 = 1e-4;
/// Less than this is no area \[pixels²\].
const SLIVER: f64 = 1e-6;

/// A corner in the picture.
#[derive(Clone, Copy)]
struct Vertex {
    place: DVec2,
    flat_depth: f64,
    is_seen: bool,
    normal: DVec3,
}

/// The nearest facet of each sample.
pub struct Raster<'a> {
    frame: Frame,
    facets: &'a Facets,
    vertices: Vec<Vertex>,
    /// The depth of each sample, and the number of its facet.
    pub nearest: Vec<f64>,
    pub holder: Vec<u32>,
}

/// A facet in the picture.
pub struct Facet {
    pub ids: [usize; 3],
    pub is_line: bool,
    corners: [Vertex; 3],
}

impl<'a> Raster<'a> {
    /// All facets that are not broken, as a frame sees them.
    pub fn new(frame: &Frame, facets: &'a Facets, broken: &[bool], position: &[DVec4]) -> Self {
        let samples = frame.samples() as usize;
        let mut raster = Self {
            frame: *frame,
            facets,
            vertices: vertices(frame, facets, broken, position),
            nearest: vec![NEVER; samples],
            holder: vec![NONE; samples],
        };
        for (i, _) in (0..facets.count).zip(broken).filter(|(_, broken)| !**broken) {
            let facet = raster.facet(i);
            if facet.corners.iter().all(|corner| corner.is_seen) {
                raster.draw(i, &facet);
            }
        }
        raster
    }
    pub fn facet(&self, i: u32) -> Facet {
        let ids = self.facets.corners(i as usize);
        let is_line = ids[2] == NONE;
        let ids = [ids[0], ids[1], if is_line { ids[1] } else { ids[2] }].map(|id| id as usize);
        Facet { ids, is_line, corners: ids.map(|id| self.vertices[id]) }
    }
    fn draw(&mut self, i: u32, facet: &Facet) {
        let frame = self.frame;
        let fine = f64::from(frame.fine);
        let [a, b, c] = facet.corners.map(|corner| corner.place);
        let reach = if facet.is_line { frame.thread } else { 0.0 };
        let end = fine * frame.size();
        let low = ((a.min(b).min(c) - reach) * fine).floor().clamp(DVec2::ZERO, end);
        let high = ((a.max(b).max(c) + reach) * fine).ceil().clamp(DVec2::ZERO, end);
        for (y, x) in (whole(low.y)..whole(high.y)).flat_map(|y| (whole(low.x)..whole(high.x)).map(move |x| (y, x))) {
            let parts = facet.parts(&frame, middle(x, y) / fine);
            let at = (y * frame.width * frame.fine + x) as usize;
            if let Some(depth) = parts.map(|parts| facet.depth(&frame, parts)).filter(|z| *z < self.nearest[at]) {
                self.nearest[at] = depth;
                self.holder[at] = i;
            }
        }
    }
}

impl Facet {
    /// Parts of the corners at a place, if that is inside.
    fn parts(&self, frame: &Frame, p: DVec2) -> Option<DVec3> {
        let (parts, inside) = self.spread(frame, p)?;
        (inside >= 0.0).then_some(parts)
    }
    /// Parts of the corners at a place, and how far inside it is; nothing where there is no area.
    fn spread(&self, frame: &Frame, p: DVec2) -> Option<(DVec3, f64)> {
        let [a, b, c] = self.corners.map(|corner| corner.place - p);
        if self.is_line {
            let way = b - a;
            let s = (-a.dot(way) / way.length_squared().max(SLIVER)).clamp(0.0, 1.0);
            return Some((DVec3::new(1.0 - s, s, 0.0), frame.thread - (a + s * way).length()));
        }
        let area = (b - a).perp_dot(c - a);
        let parts = DVec3::new(b.perp_dot(c), c.perp_dot(a), a.perp_dot(b)) / area;
        (area.abs() >= SLIVER).then(|| (parts, parts.min_element() + SLACK))
    }
    /// The same where it is known to be inside.
    pub fn within(&self, frame: &Frame, p: DVec2) -> DVec3 {
        self.spread(frame, p).map_or(DVec3::X, |(parts, _)| parts)
    }
    /// A line is as thick as it is wide, and its front as near.
    pub fn depth(&self, frame: &Frame, parts: DVec3) -> f64 {
        let [a, b, c] = self.corners.map(|corner| corner.flat_depth);
        let bulge = if self.is_line { frame.thread / frame.scale() } else { 0.0 };
        frame.flat_depth(parts.dot(DVec3::new(a, b, c))) - bulge
    }
    pub fn normal(&self, parts: DVec3) -> DVec3 {
        mean(parts, |k| self.corners[k].normal).normalize_or_zero()
    }
    /// Corners that go round against the clock are seen from the front; right and down is left-handed.
    pub fn is_front(&self) -> bool {
        let [a, b, c] = self.corners.map(|corner| corner.place);
        (b - a).perp_dot(c - a) <= 0.0
    }
}

/// A mean of three corners'.
pub fn mean(parts: DVec3, of: impl Fn(usize) -> DVec3) -> DVec3 {
    parts.x * of(0) + parts.y * of(1) + parts.z * of(2)
}

/// Corners, with the normal of the surface around them, or the direction of the lines.
fn vertices(frame: &Frame, facets: &Facets, broken: &[bool], position: &[DVec4]) -> Vec<Vertex> {
    let mut sums = vec![DVec3::ZERO; position.len()];
    for (id, around) in facets.around(position.len()) {
        for t in around.iter().filter(|t| !broken[**t as usize]) {
            let ids = facets.corners(*t as usize);
            let at = |k: usize| position[ids[k] as usize].truncate();
            let way = at(1) - at(0);
            let part = if ids[2] == NONE { way } else { way.cross(at(2) - at(0)) };
            if part.is_finite() {
                sums[id] += part;
            }
        }
    }
    let camera = frame.camera;
    let vertex = |(x, sum): (&DVec4, DVec3)| {
        let seen = frame.see(x.truncate());
        let normal = DVec3::new(sum.dot(camera.right), sum.dot(camera.up), sum.dot(camera.back)).normalize_or_zero();
        let is_seen = seen.visible && x.is_finite();
        Vertex { place: seen.place, flat_depth: frame.flat_depth(seen.depth), is_seen, normal }
    };
    position.iter().zip(sums).map(vertex).collect()
}
