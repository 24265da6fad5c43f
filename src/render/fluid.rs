//! Parameters of a fluid in pictures, from the scene and the particles.

use glam::DVec3;

use super::{Camera, Scenery};
use crate::kernel::Scalar;
use crate::settings::Settings;
use crate::state::State;

/// Radii of drops, as a part of how far apart they are: with less there are holes, with more a fluid is fat.
const FULL: f64 = 0.75;
/// The same in a plane, where none is behind a hole.
const FULL_FLAT: f64 = 0.95;
const ALONE: f64 = 0.2;
/// How far the edge of a drop is behind its front \[drop\]: at the edge of a fluid nothing smooths what is steep. In parallel
/// rays, as a plane is looked at, a fluid is nearly flat.
const OBLATE: f64 = 0.7;
const OBLATE_FLAT: f64 = 0.3;
/// How far the surface is made smooth \[drops\], and how much nearer and farther the same surface may be.
const CALM: f64 = 2.0;
const RANGE: f64 = 3.0;
/// The same, at most \[pixels\].
const FARTHEST: u32 = 48;
/// How often along rows and columns the surface is made smooth: the mean over a square by two of them is a cross where the
/// range cuts it off.
pub const ROUNDS: usize = 3;
/// By so many particles it is judged how far apart they are.
const SAMPLE: usize = 64;
/// How deep one sees into water, as a part of half the height of the picture; and into what is coloured \[drops\].
const WATER: f64 = 0.11;
const PAINT: f64 = 0.1;
/// Of water: green is absorbed less than red, blue least.
pub const DYE: [u8; 3] = [18, 112, 176];

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
    /// Half the width of a tank's edge \[pixels\].
    pub wire: f64,
    /// Edges of tanks.
    pub edges: u32,
}

impl Water {
    /// By their names in shaders.
    pub(super) fn values(&self) -> [(&'static str, Scalar); 13] {
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
            ("wire", float(self.wire)),
            ("edges", Scalar::Uint(self.edges)),
        ]
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
        let clarity = settings.number("clarity");
        let depth = match (clarity > 0.0, painted) {
            (true, _) => clarity,
            (false, false) => WATER * camera.extent,
            (false, true) => PAINT * drop,
        };
        let parallel = settings.text("projection") == "orthographic";
        let foam = settings.number("foam");
        let bright = ["dusk", "day"].contains(&settings.text("background"));
        Self {
            drop,
            oblate: if parallel { OBLATE_FLAT } else { OBLATE },
            grain,
            // A drop overlaps with others: of its ball it has but its own share, a cube.
            layer: 2.0 * drop / grain / (4.0 / 3.0 * std::f64::consts::PI * FULL.powi(3)),
            absorption: depth.recip(),
            stain: if painted { 0.0 } else { 1.0 },
            foam: if foam > 0.0 { foam } else { super::frame::NEVER },
            range: RANGE,
            calm: CALM,
            farthest: FARTHEST,
            gloss: if bright { 1.0 } else { 0.55 },
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
    let flat = places.windows(2).all(|pair| (pair[1].z - pair[0].z).abs() <= 0.0);
    let part = if flat { FULL_FLAT } else { FULL };
    if all.is_empty() { 0.0 } else { part * *all.select_nth_unstable_by(middle, f64::total_cmp).1 }
}
