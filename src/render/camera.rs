//! The view of a picture.

use glam::DVec3;

use super::{KEYS, Trail};
use crate::kernel::{Bounds, Side};
use crate::settings::{Settings, Value};
use crate::state::State;

/// An eye, its target, and the extent of the picture.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Camera {
    /// The point in the middle of the picture.
    pub center: DVec3,
    /// From the centre towards the eye; of length 1, as are `right` and `up`.
    pub back: DVec3,
    /// The direction to the right in the picture.
    pub right: DVec3,
    /// The upward direction in the picture.
    pub up: DVec3,
    /// Half the height of the picture, at the centre \[length\].
    pub extent: f64,
    /// From the centre to the eye \[length\]; zero for parallel rays.
    pub distance: f64,
}

/// Half the height of the picture at the distance 1 from the eye: an angle of view of 30°.
const HALF_VIEW: f64 = 0.268;
/// Nearer to the eye than this part of its distance nothing is drawn: as in `shaders/render/frame.wgsl`.
const NEAR: f64 = 0.05;
/// So few particles are all in the picture, and leave trails; of more, the outermost are left to themselves.
pub const FEW: usize = 64;
/// The part of many particles that may lie beyond each edge before the margin is added.
const OUTER: f64 = 0.03;
/// The margin around the particles, as a part of their extent.
const MARGIN: f64 = 0.14;
/// The maximum number of particles used for framing.
const SAMPLE: usize = 20_000;

impl Camera {
    /// The camera of a scene's `[picture]`, with all that matters of these particles and their trails in view.
    #[must_use]
    pub fn fit(particles: &State, trail: &Trail, settings: &Settings) -> Self {
        let back = settings.vector("eye").normalize_or(DVec3::NEG_Y);
        let wanted = settings.vector("up").cross(back);
        // Straight from above, up in the picture is y.
        let right = wanted.try_normalize().unwrap_or_else(|| DVec3::Y.cross(back).normalize_or(DVec3::X));
        let perspective = settings.text("projection") == "perspective";
        let mut camera =
            Self { center: settings.vector("center"), back, right, up: back.cross(right), extent: 1.0, distance: 0.0 };
        if settings.flag("auto_frame") {
            camera.frame(particles, trail, settings.number("width") / settings.number("height"), perspective);
        } else {
            camera.reach(settings.number("extent"), perspective);
        }
        camera
    }

    /// Its projection, as the key of that name has it.
    #[must_use]
    pub fn projection(&self) -> &'static str {
        if self.distance > 0.0 { "perspective" } else { "orthographic" }
    }
    /// The same view of an extent larger by a factor.
    #[must_use]
    pub fn wider(self, factor: f64) -> Self {
        Self { extent: self.extent * factor, distance: self.distance * factor, ..self }
    }
    /// Where a point is seen, to the right and up from the middle of the picture \[halves of its height\]; nothing where it is behind the
    /// eye, or so near to it that it is not drawn.
    #[must_use]
    pub fn sees(&self, point: DVec3) -> Option<[f64; 2]> {
        let r = point - self.center;
        let nearer = if self.distance > 0.0 { 1.0 - r.dot(self.back) / self.distance } else { 1.0 };
        let scale = 1.0 / (self.extent * nearer);
        (nearer > NEAR && scale.is_finite()).then(|| [r.dot(self.right) * scale, r.dot(self.up) * scale])
    }
    /// What is seen at a place on the picture \[halves of its height, to the right and up from its middle\]: the point of it that is as far away as the
    /// centre, and the direction away from the eye.
    #[must_use]
    pub fn ray(&self, across: f64, up: f64) -> (DVec3, DVec3) {
        let beside = self.extent * (across * self.right + up * self.up);
        let away = if self.distance > 0.0 { beside - self.distance * self.back } else { -self.back };
        (self.center + beside, away.normalize_or(-self.back))
    }
    fn reach(&mut self, extent: f64, perspective: bool) {
        self.extent = extent;
        self.distance = if perspective { extent / HALF_VIEW } else { 0.0 };
    }

    fn frame(&mut self, particles: &State, trail: &Trail, aspect: f64, perspective: bool) {
        let few = particles.len() <= FEW;
        // An odd number: every eighth particle of strands of sixteen would leave out all their ends.
        let stride = particles.len().div_ceil(SAMPLE) | 1;
        let mut shapes: Vec<(DVec3, f64)> =
            particles.position().iter().copied().zip(particles.size().iter().copied()).step_by(stride).collect();
        if particles.population().active > 0 {
            let is_active = (0..particles.len()).step_by(stride).map(|id| particles.is_active(id));
            shapes =
                shapes.into_iter().zip(is_active).filter_map(|(shape, is_active)| is_active.then_some(shape)).collect();
        }
        shapes.extend(trail.points().map(|x| (x, 0.0)));
        shapes.retain(|(x, radius)| x.is_finite() && radius.is_finite());
        if shapes.is_empty() {
            return self.reach(1.0, perspective);
        }
        let outer = if few { 0.0 } else { OUTER };
        let depth = |(x, _): &(DVec3, f64)| x.dot(self.back);
        let (near, far) = span(shapes.iter().map(|s| (depth(s), depth(s))), outer);
        let mut middle = DVec3::new(0.0, 0.0, 0.5 * (near + far));
        let mut extent = 0.0;
        // Nearer objects look larger: the frame changes the picture of the particles, and a few iterations converge.
        for _ in 0..6 {
            let back = self.back;
            let distance = if perspective && extent > 0.0 { extent / HALF_VIEW } else { f64::INFINITY };
            let (shapes, depth_of_center) = (&shapes, middle.z);
            let seen = |direction: DVec3, center: f64| {
                shapes.iter().map(move |(x, radius)| {
                    let depth = (x.dot(back) - depth_of_center) / distance;
                    let larger = 1.0 / (1.0 - depth.min(0.8));
                    let at = (x.dot(direction) - center) * larger;
                    (at - radius * larger, at + radius * larger)
                })
            };
            let (left, right) = span(seen(self.right, middle.x), outer);
            let (low, high) = span(seen(self.up, middle.y), outer);
            middle += DVec3::new(0.5 * (left + right), 0.5 * (low + high), 0.0);
            extent = (0.5 * (high - low)).max(0.5 * (right - left) / aspect) * (1.0 + MARGIN);
        }
        self.center = middle.x * self.right + middle.y * self.up + middle.z * self.back;
        // A single point has no extent, and f32 resolves none smaller than this.
        let least = 1e-5 * self.center.length();
        self.reach(if extent > least { extent } else { least.max(1.0) }, perspective);
    }
}

/// The same settings with a closed box in view, if the frame is not given.
#[must_use]
pub fn framed(settings: &Settings, bounds: &Bounds) -> Settings {
    let straight = bounds.dimensions == 2 && super::styles::of(settings).style.is_fluid();
    let settings = &if straight { facing(settings) } else { settings.clone() };
    let axes = usize::try_from(bounds.dimensions).unwrap_or(3).min(3);
    if !settings.flag("auto_frame") || bounds.sides[..axes].contains(&Side::Open) {
        return settings.clone();
    }
    let mut corners = State::default();
    for corner in 0..1 << axes {
        let bit = |axis: usize| f64::from(corner >> axis & 1);
        let along = |axis: usize| {
            if axis < axes { bounds.low[axis] + bit(axis) * (bounds.high[axis] - bounds.low[axis]) } else { 0.0 }
        };
        corners.push(DVec3::new(along(0), along(1), along(2)), DVec3::ZERO, 0.0, 0.0);
    }
    let camera = Camera::fit(&corners, &Trail::new(0), settings);
    let (center, extent) = (Value::Vector(camera.center), Value::Number(camera.extent));
    settings.clone().with("auto_frame", Value::Flag(false)).with("center", center).with("extent", extent)
}

/// A fluid in a plane is seen straight from above, unless the scene gives another direction, and without a perspective, in which its
/// edge would not meet its walls.
fn facing(settings: &Settings) -> Settings {
    let usual = KEYS.iter().find(|key| key.name == "eye").and_then(|key| key.default.clone());
    let eye = settings.vector("eye");
    let straight = eye.x == 0.0 && eye.y == 0.0 && eye.z != 0.0;
    if !straight && usual != Some(Value::Vector(eye)) {
        return settings.clone();
    }
    let eye = if straight { eye } else { DVec3::Z };
    let flat = Value::Text("orthographic".into());
    settings.clone().with("eye", Value::Vector(eye)).with("projection", flat)
}

/// So much longer than the rest the whole must be before its ends are taken for stragglers.
const STRAGGLING: f64 = 2.0;

/// From the lowest to the highest of some intervals; without the `outer` part of each end, if that is far off.
fn span(intervals: impl Iterator<Item = (f64, f64)>, outer: f64) -> (f64, f64) {
    let (mut low, mut high): (Vec<f64>, Vec<f64>) = intervals.unzip();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::cast_precision_loss,
        reason = "a part of a length"
    )]
    let skip = ((low.len().max(1) - 1) as f64 * outer) as usize;
    let last = high.len() - 1 - skip;
    let lowest = low.iter().copied().fold(f64::INFINITY, f64::min);
    let highest = high.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let (low, high) =
        (*low.select_nth_unstable_by(skip, f64::total_cmp).1, *high.select_nth_unstable_by(last, f64::total_cmp).1);
    if highest - lowest <= STRAGGLING * (high - low) { (lowest, highest) } else { (low, high) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_seen_in_halves_of_the_height() {
        let (center, extent) = (DVec3::new(1.0, 2.0, 3.0), 4.0);
        let (back, right, up) = (DVec3::Y, DVec3::NEG_X, DVec3::Z);
        let camera = |distance| Camera { center, back, right, up, extent, distance };
        let x = center + extent * (0.5 * right - 0.25 * up);
        for distance in [0.0, 10.0] {
            assert_eq!(camera(distance).sees(x), Some([0.5, -0.25]));
        }
        assert_eq!(camera(0.0).sees(x + 100.0 * back), Some([0.5, -0.25]));
        // Half as far from the eye it is seen twice as large, and behind it not at all.
        assert_eq!(camera(10.0).sees(x + 5.0 * back), Some([1.0, -0.5]));
        assert_eq!(camera(10.0).sees(x + 9.6 * back), None);
        assert_eq!(camera(10.0).sees(x + 20.0 * back), None);
    }
    #[test]
    fn all_of_a_ray_is_seen_at_its_place() {
        let (center, extent) = (DVec3::new(1.0, 2.0, 3.0), 4.0);
        let (back, right, up) = (DVec3::Y, DVec3::NEG_X, DVec3::Z);
        for distance in [0.0, 10.0] {
            let camera = Camera { center, back, right, up, extent, distance };
            let (point, direction) = camera.ray(0.5, -0.25);
            assert!((direction.length() - 1.0).abs() < 1e-12 && direction.dot(back) < 0.0, "{direction}");
            for along in [-6.0, 0.0, 30.0] {
                let [across, above] = camera.sees(point + along * direction).expect("in front of the eye");
                assert!((across - 0.5).abs() < 1e-12 && (above + 0.25).abs() < 1e-12, "{across} {above} at {along}");
            }
        }
    }
    #[test]
    fn stragglers_are_left_out_and_edges_are_not() {
        let line = |end: f64| (0..100_u32).map(|i| f64::from(i) / 99.0).chain([end]).map(|x| (x, x));
        assert_eq!(span(line(1.2), 0.03), (0.0, 1.2));
        let (low, high) = span(line(50.0), 0.03);
        assert!(low > 0.02 && high < 1.0, "{low} {high}");
        assert_eq!(span(line(50.0), 0.0), (0.0, 50.0));
    }
    /// The part of the picture that these particles and trails fill, from the middle to the fuller edge.
    fn filled(shapes: &[(DVec3, f64)], past: &[DVec3], projection: &'static str) -> f64 {
        let mut particles = State::default();
        for (x, radius) in shapes {
            particles.push(*x, DVec3::ZERO, 1.0, *radius);
        }
        let mut trail = Trail::new(shapes.len());
        trail.push(past);
        let word = crate::settings::Value::Text(projection.into());
        let settings = Settings::defaults(super::super::KEYS).with("projection", word);
        let camera = Camera::fit(&particles, &trail, &settings);
        let part = |(x, radius): (DVec3, f64)| {
            let r = x - camera.center;
            let near = if camera.distance > 0.0 { r.dot(camera.back) / camera.distance } else { 0.0 };
            let across = (r.dot(camera.right).abs() + radius) / (1.0 - near) * 720.0 / 1280.0;
            across.max((r.dot(camera.up).abs() + radius) / (1.0 - near)) / camera.extent
        };
        shapes.iter().copied().chain(past.iter().map(|x| (*x, 0.0))).map(part).fold(0.0, f64::max)
    }
    #[test]
    fn few_particles_are_all_in_the_picture_with_their_balls_and_trails() {
        let left = DVec3::new(-5.0, -9.0, -12.0);
        let (high, wide) = (DVec3::new(0.0, 30.0, -12.0), DVec3::new(90.0, 1.0, 0.0));
        let two = [(DVec3::new(7.0, 1.0, -2.0), 0.5), (DVec3::new(-3.0, -20.0, 4.0), 0.1)];
        let large = [(DVec3::new(7.0, 1.0, -2.0), 15.0), (DVec3::new(-3.0, -2.0, 4.0), 9.0)];
        for projection in ["perspective", "orthographic"] {
            for (shapes, past) in [(two, high), (two, wide), (large, left), (large, -left)] {
                let filled = filled(&shapes, &[DVec3::new(0.0, 2.0, -3.0), past], projection);
                assert!((0.85..0.9).contains(&filled), "{projection} {past}: {filled}");
            }
        }
    }
    #[test]
    fn a_box_that_is_closed_all_round_is_all_in_the_picture() {
        let settings = Settings::defaults(super::super::KEYS);
        let (low, high) = (DVec3::new(3.0, -1.0, 2.0), DVec3::new(9.0, 4.0, 5.0));
        for flat in [false, true] {
            let (low, high) = if flat { (low.with_z(7.0), high.with_z(7.0)) } else { (low, high) };
            let bounds = Bounds::new(low, high, Side::Reflecting);
            let framed = framed(&settings, &bounds);
            let mut particles = State::default();
            particles.push(DVec3::ZERO, DVec3::ZERO, 1.0, 0.0);
            // Whatever the particles.
            let camera = Camera::fit(&particles, &Trail::new(0), &framed);
            let mut fullest = 0.0_f64;
            for corner in 0..8_u8 {
                let pick = |bit: u8, low: f64, high: f64| if corner >> bit & 1 == 1 { high } else { low };
                let z = if flat { 0.0 } else { pick(2, low.z, high.z) };
                let r = DVec3::new(pick(0, low.x, high.x), pick(1, low.y, high.y), z) - camera.center;
                let near = r.dot(camera.back) / camera.distance;
                let across = r.dot(camera.right).abs() * 720.0 / 1280.0;
                fullest = fullest.max(across.max(r.dot(camera.up).abs()) / (1.0 - near) / camera.extent);
            }
            assert!((0.85..0.9).contains(&fullest), "{fullest}");
            let pipe = Bounds { sides: [Side::Periodic, Side::Open, Side::Periodic], ..bounds };
            assert_eq!(super::framed(&settings, &pipe), settings);
        }
        let own = settings.with("auto_frame", Value::Flag(false));
        assert_eq!(super::framed(&own, &Bounds::new(low, high, Side::Periodic)), own);
    }
}
