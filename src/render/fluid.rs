//! Parameters of a fluid in pictures, from the scene and the particles.

use glam::{DVec2, DVec3};

use super::frame::{Frame, NEVER, whole};
use super::{Camera, Scenery};
use crate::kernel::{Bounds, Scalar, Side};
use crate::settings::Settings;
use crate::state::State;

/// Radii of drops, as a part of how far apart they are: with less there are holes, with more a fluid is fat.
const FULL: f64 = 0.75;
const ALONE: f64 = 0.2;
/// How far the edge of a drop is behind its front \[drop\]: at the edge of a fluid nothing smooths what is steep. In parallel
/// rays a fluid is nearly flat.
const OBLATE: f64 = 0.7;
const OBLATE_FLAT: f64 = 0.3;
/// How wide the outline is made smooth \[drops\]: bumps of drops side by side are gone, and one alone is still seen.
const SOFT: f64 = 2.0;
/// The same in space, where drops are seen beside and behind each other: of one alone, and of many.
const SOFT_ALONE: f64 = 1.25;
const SOFT_MANY: f64 = 4.0;
/// How far the surface is made smooth \[drops\], and how much nearer and farther the same surface may be.
const CALM: f64 = 2.0;
const RANGE: f64 = 3.0;
/// The same, at most \[pixels\].
const FARTHEST: u32 = 48;
/// How often along rows and columns the surface is made smooth: the mean over a square by two of them is a cross where the
/// range cuts it off.
pub const ROUNDS: usize = 3;
/// Beyond every picture \[pixels\].
const FAR: f64 = 1e5;
/// By so many particles it is judged how far apart they are.
const SAMPLE: usize = 64;
/// How deep one sees into water, as a part of half the height of the picture; and into what is coloured \[drops\].
const WATER: f64 = 0.11;
const PAINT: f64 = 0.1;
/// Of water: green is absorbed less than red, blue least.
pub const DYE: [u8; 3] = [18, 112, 176];

/// The sides of a plane at which a fluid ends.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// The lower corner; beyond every number where it does not end \[length\].
    pub low: DVec2,
    /// The upper corner \[length\].
    pub high: DVec2,
    /// Along which axes it goes on at the other side.
    pub periodic: [bool; 2],
}

impl Default for Plane {
    fn default() -> Self {
        Self { low: DVec2::splat(-NEVER), high: DVec2::splat(NEVER), periodic: [false; 2] }
    }
}

impl Plane {
    /// That of a box; without an end in three dimensions.
    #[must_use]
    pub fn of(bounds: &Bounds) -> Self {
        if bounds.dimensions != 2 {
            return Self::default();
        }
        let end = |axis: usize, at: f64, open: f64| if bounds.sides[axis] == Side::Open { open } else { at };
        let corner = |at: DVec3, open: f64| DVec2::new(end(0, at.x, open), end(1, at.y, open));
        let periodic = [0, 1].map(|axis| bounds.sides[axis] == Side::Periodic);
        Self { low: corner(bounds.low, -NEVER), high: corner(bounds.high, NEVER), periodic }
    }
}

/// The same in a picture \[pixels\].
pub struct Ends {
    pub low: DVec2,
    pub high: DVec2,
    /// How wide and high it is where it is periodic, else 0.
    pub wraps: [u32; 2],
}

impl Ends {
    /// By their names in shaders.
    pub fn values(&self) -> [(&'static str, Scalar); 6] {
        let float = Scalar::Float;
        [
            ("left", float(self.low.x)),
            ("right_end", float(self.high.x)),
            ("top", float(self.low.y)),
            ("bottom", float(self.high.y)),
            ("wrap_across", Scalar::Uint(self.wraps[0])),
            ("wrap_down", Scalar::Uint(self.wraps[1])),
        ]
    }
}

/// What a fluid looks like.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Water {
    /// The radius of a drop \[length\]; zero where there is no fluid.
    pub drop: f64,
    /// How far its edge is behind its front, as a part of that.
    pub oblate: f64,
    /// Parts in which the thickness of a drop is counted.
    pub grain: f64,
    /// The thickness that one of those stands for \[length\].
    pub layer: f64,
    /// How much of it absorbs light \[1 / length\].
    pub absorption: f64,
    /// How much less it absorbs of the light of its own colour: 1 for water, 0 for paint.
    pub stain: f64,
    /// The speed from which on it is white \[length / time\].
    pub foam: f64,
    /// How much nearer and farther the same surface may be \[drops\].
    pub range: f64,
    /// How wide the surface is made smooth \[drops\].
    pub calm: f64,
    /// The same, at most \[pixels\].
    pub farthest: u32,
    /// Brightness of the sky that it mirrors.
    pub gloss: f64,
    /// How wide its outline is made smooth \[pixels\].
    pub soft: u32,
    /// The same for many drops in space \[pixels\].
    pub softer: u32,
    /// How far normals turn outwards at an outline: 1, or 0 for a fluid in a plane.
    pub turn: f64,
    /// The box of a fluid in a plane.
    pub plane: Plane,
    /// Half the width of a tank's edge \[pixels\].
    pub wire: f64,
    /// Edges of tanks.
    pub edges: u32,
}

impl Water {
    /// By their names in shaders.
    pub(super) fn values(&self) -> [(&'static str, Scalar); 16] {
        let float = Scalar::Float;
        [
            ("drop", float(self.drop)),
            ("oblate", float(self.oblate)),
            ("grain", float(self.grain)),
            ("layer", float(self.layer)),
            ("absorption", float(self.absorption)),
            ("stain", float(self.stain)),
            ("foam", float(self.foam)),
            ("range", float(self.range)),
            ("calm", float(self.calm)),
            ("farthest", Scalar::Uint(self.farthest)),
            ("gloss", float(self.gloss)),
            ("soft", Scalar::Uint(self.soft)),
            ("softer", Scalar::Uint(self.softer)),
            ("turn", float(self.turn)),
            ("wire", float(self.wire)),
            ("edges", Scalar::Uint(self.edges)),
        ]
    }
    /// Where a fluid in a plane ends in the picture.
    pub(super) fn ends(&self, frame: &Frame) -> Ends {
        let camera = &frame.camera;
        let far = DVec2::splat(FAR);
        let along = |way: DVec3| way.abs().max_element() > 1.0 - 1e-9;
        if self.turn > 0.0 || camera.distance > 0.0 || !along(camera.right) || !along(camera.up) {
            return Ends { low: -far, high: far, wraps: [0; 2] };
        }
        let seen = [self.plane.low, self.plane.high].map(|x| frame.see(x.extend(camera.center.z)).place);
        let (low, high) = (seen[0].min(seen[1]).clamp(-far, far), seen[0].max(seen[1]).clamp(-far, far));
        // Seen from the side, x may go up.
        let axes = if camera.right.x.abs() > 0.5 { [0, 1] } else { [1, 0] };
        let wrap = |k: usize| if self.plane.periodic[axes[k]] { whole((high - low)[k].round()) } else { 0 };
        Ends { low, high, wraps: [wrap(0), wrap(1)] }
    }
    /// Whether there is a fluid.
    #[must_use]
    pub fn is_there(&self) -> bool {
        self.drop > 0.0
    }
}

impl Water {
    /// That of a scene's `[picture]`; `painted` where colours say something.
    pub(super) fn of(
        settings: &Settings,
        particles: &State,
        scenery: &Scenery,
        camera: &Camera,
        painted: bool,
    ) -> Self {
        if !super::styles::of(settings).style.is_fluid() {
            return Self::default();
        }
        let given = settings.number("drop");
        let usual = || if scenery.drop > 0.0 { scenery.drop } else { drop_of(particles) };
        let drop = if given > 0.0 { given } else { usual() };
        // One alone is as large as it looks well.
        let drop = if drop > 0.0 { drop } else { ALONE * camera.extent };
        let count = u32::try_from(particles.len()).unwrap_or(u32::MAX).max(1);
        // All drops on one pixel do not overflow, and a half of one is added to each.
        let grain = f64::from(1_u32 << (u32::MAX / count).ilog2().saturating_sub(1).min(16));
        let flat = is_flat(particles.position()) && camera.back.z.abs() > 1.0 - 1e-9;
        let oblate = match (flat, camera.distance == 0.0) {
            (true, _) => 0.0,
            (false, true) => OBLATE_FLAT,
            (false, false) => OBLATE,
        };
        let scale = 0.5 * settings.number("height") / camera.extent;
        let clarity = settings.number("clarity");
        let depth = match (clarity > 0.0, painted) {
            (true, _) => clarity,
            (false, false) if !flat => WATER * camera.extent,
            (false, _) => PAINT * drop,
        };
        let foam = settings.number("foam");
        let bright = ["dusk", "day", "paper"].contains(&settings.text("background"));
        let wide = |drops: f64| whole((drops * drop * scale).clamp(1.0, f64::from(FARTHEST)));
        Self {
            drop,
            oblate,
            grain,
            // A drop overlaps with others: of its ball it has but its own share, a cube.
            layer: 2.0 * drop / grain / (4.0 / 3.0 * std::f64::consts::PI * FULL.powi(3)),
            absorption: depth.recip(),
            stain: if painted { 0.0 } else { 1.0 },
            foam: if foam > 0.0 { foam } else { NEVER },
            range: RANGE,
            calm: CALM,
            farthest: FARTHEST,
            gloss: if bright { 1.0 } else { 0.9 },
            soft: wide(if flat { SOFT } else { SOFT_ALONE }),
            softer: wide(0.5 * SOFT_MANY) * 2,
            turn: if flat { 0.0 } else { 1.0 },
            plane: scenery.plane,
            wire: (settings.number("width").min(settings.number("height")) / 1400.0).max(0.25),
            edges: 0,
        }
    }
}

/// The radius of drops of particles that are not fixed, by the middle of the distances from some to their nearest; zero
/// where there is but one.
pub fn drop_of(particles: &State) -> f64 {
    let mut free = vec![true; particles.len()];
    for one in &particles.held {
        if let Some(one) = free.get_mut(one.id as usize) {
            *one = false;
        }
    }
    let of = |id: usize| free[id] && particles.position()[id].is_finite();
    let places: Vec<DVec3> = (0..free.len()).filter(|id| of(*id)).map(|id| particles.position()[id]).collect();
    let nearest = |x: &DVec3| {
        let squares = places.iter().map(|y| x.distance_squared(*y)).filter(|square| *square > 0.0);
        squares.fold(f64::INFINITY, f64::min).sqrt()
    };
    let stride = places.len().div_ceil(SAMPLE).max(1);
    let mut all: Vec<f64> = places.iter().step_by(stride).map(nearest).filter(|r| r.is_finite()).collect();
    let middle = all.len() / 2;
    if all.is_empty() { 0.0 } else { FULL * *all.select_nth_unstable_by(middle, f64::total_cmp).1 }
}

/// Whether some places are in one plane z = const.
fn is_flat(places: &[DVec3]) -> bool {
    places.windows(2).all(|pair| (pair[1].z - pair[0].z).abs() <= 0.0)
}
