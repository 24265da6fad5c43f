//! Colours of groups and of particles in a picture.

use glam::DVec3;

use super::camera::FEW;
use super::frame::whole;
use crate::settings::Settings;
use crate::state::State;

/// Colours that stay apart on a dark background, for most eyes; red, green, blue.
const PALETTE: [[u8; 3]; 10] = [
    [255, 190, 92],
    [94, 160, 255],
    [255, 112, 122],
    [104, 222, 148],
    [198, 150, 255],
    [70, 214, 226],
    [255, 146, 66],
    [242, 240, 234],
    [240, 130, 210],
    [184, 204, 84],
];

/// The quantity that determines a particle's colour.
#[derive(Debug, Clone, PartialEq)]
pub enum Color {
    /// A colour for each particle, as [`pack`]ed bytes.
    Given(Vec<u32>),
    /// Its speed, on a scale between two speeds \[length / time\].
    Speed {
        /// The dark end.
        slow: f64,
        /// The bright end.
        fast: f64,
    },
    /// The heading: the hue by the angle in the plane of x and y, the lightness by the climb along z.
    Heading,
}

/// Red in the lowest byte.
#[must_use]
pub fn pack(rgb: [u8; 3]) -> u32 {
    u32::from_le_bytes([rgb[0], rgb[1], rgb[2], 255])
}

/// The colour of a group.
#[must_use]
pub fn group_color(group: u32) -> [u8; 3] {
    PALETTE[group as usize % PALETTE.len()]
}

/// The slowest, three between, the fastest: lighter from each to the next but the last.
const SPEEDS: [DVec3; 5] = [
    DVec3::new(0.26, 0.28, 0.84),
    DVec3::new(0.29, 0.54, 0.96),
    DVec3::new(0.52, 0.79, 0.94),
    DVec3::new(0.96, 0.90, 0.74),
    DVec3::new(1.0, 0.77, 0.38),
];

/// The colour of a speed, as a part of the way from the slow end to the fast one.
pub(super) fn by_speed(part: f64) -> DVec3 {
    along(&SPEEDS, part)
}

/// The colour at a part of a scale of evenly spaced colours.
pub(super) fn along(scale: &[DVec3], part: f64) -> DVec3 {
    let steps = scale.len() - 1;
    let place = part.clamp(0.0, 1.0) * steps as f64;
    let low = (whole(place) as usize).min(steps - 1);
    scale[low].lerp(scale[low + 1], place - low as f64)
}

impl Color {
    /// By the scene's `color`. `groups` has a number for each particle, or is empty when all are one group.
    #[must_use]
    pub fn choose(settings: &Settings, particles: &State, groups: &[u32]) -> Self {
        let several = groups.iter().any(|g| Some(g) != groups.first());
        let few = particles.len() <= FEW;
        let by_speed = match settings.text("color") {
            "speed" => true,
            "group" => false,
            "heading" => return Self::Heading,
            _ => !several && !few,
        };
        if by_speed {
            return Self::by_speed(particles);
        }
        let group = |i: usize| {
            // Of a few particles that are all one group each has a colour of its own.
            let own = if few && !several { u32::try_from(i).ok() } else { groups.get(i).copied() };
            pack(group_color(own.unwrap_or(0)))
        };
        Self::Given((0..particles.len()).map(group).collect())
    }

    fn by_speed(particles: &State) -> Self {
        let mut speeds: Vec<f64> = particles.velocity().iter().map(|v| v.length()).filter(|v| v.is_finite()).collect();
        if speeds.is_empty() {
            return Self::Speed { slow: 0.0, fast: 1.0 };
        }
        speeds.sort_unstable_by(f64::total_cmp);
        let (slow, fast) = (speeds[speeds.len() / 50], speeds[(speeds.len() - 1) - speeds.len() / 50]);
        // All equally fast: the middle of the scale.
        let least = 1e-3 * fast.abs().max(1e-30);
        if fast - slow > least {
            Self::Speed { slow, fast }
        } else {
            Self::Speed { slow: slow - least, fast: fast + least }
        }
    }
}
