//! Colours of groups and of particles in a picture.

use glam::DVec3;

use super::camera::FEW;
use super::frame::whole;
use crate::kernel::{Array, Column};
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
    /// A column of this name, before a simulation has [scaled](crate::Simulation::scale) its values.
    Column(String),
    /// A column, or the length of its vectors, on a scale between two values.
    Value(Box<Scaled>),
    /// The heading: the hue by the angle in the plane of x and y, the lightness by the climb along z.
    Heading,
}

/// A column with the ends of its scale.
#[derive(Debug, Clone, PartialEq)]
pub struct Scaled {
    /// The column.
    pub column: Column,
    /// The dark end.
    pub low: f64,
    /// The bright end.
    pub high: f64,
    /// Whether the scale is logarithmic.
    pub logarithmic: bool,
}

#[cfg(feature = "panel")]
impl Color {
    /// Whether another one shows the same quantity, perhaps on another scale, or on none yet.
    pub(crate) fn shows_as(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::Speed { .. }, Self::Speed { .. }) => true,
            (Self::Value(scaled), Self::Column(name)) => scaled.column.name == *name,
            _ => false,
        }
    }
    /// The same quantity of another state, on a scale of its own, or on none yet; nothing where no scale is.
    pub(crate) fn anew(&self, state: &State) -> Option<Self> {
        match self {
            Self::Speed { .. } => Some(Self::by_speed(state)),
            Self::Value(scaled) => Some(Self::Column(scaled.column.name.to_string())),
            Self::Given(_) | Self::Column(_) | Self::Heading => None,
        }
    }
    /// Whether values with a scale of their own are shown well on this one: they neither reach far beyond it nor fill less than half of it.
    pub(crate) fn fits(&self, own: &Self) -> bool {
        let (least, most) = match (self, own) {
            (Self::Value(known), Self::Value(own)) if known.logarithmic && own.low <= 0.0 => return false,
            // On the kind of scale that there is, which values near the border of both would change again and again.
            (Self::Value(known), Self::Value(own)) => {
                Scaled { logarithmic: known.logarithmic, ..(**own).clone() }.ends()
            }
            _ => own.ends(),
        };
        let (low, high) = self.ends();
        let (width, filled) = (high - low, most - least);
        (low - least).max(most - high) <= 0.5 * width && filled >= 0.5 * width
    }
}

/// Values this far apart, as a factor, are on a logarithmic scale.
const DECADES: f64 = 100.0;

impl Scaled {
    /// On a scale that leaves out the lowest and the highest 2 % of these values; it is logarithmic where all are positive and they are far apart.
    #[must_use]
    pub fn of(column: Column, values: impl IntoIterator<Item = f64>) -> Self {
        let (low, high) = ends(values);
        let logarithmic = low > 0.0 && high / low > DECADES;
        Self { column, low, high, logarithmic }
    }
    /// Its name and its unit.
    #[must_use]
    pub fn title(&self) -> String {
        self.column.with_unit(&self.column.name)
    }
    /// The ends as shaders have them.
    pub(super) fn ends(&self) -> (f64, f64) {
        if self.logarithmic { (self.low.ln(), self.high.ln()) } else { (self.low, self.high) }
    }
    /// The colour of a value.
    #[must_use]
    pub fn color(&self, value: f64) -> DVec3 {
        if !value.is_finite() {
            return DVec3::splat(0.5);
        }
        let (low, high) = self.ends();
        let value = if self.logarithmic { value.max(1e-37).ln() } else { value };
        value_color((value - low) / (high - low))
    }
    /// The value of each row: a number, or the length of a vector.
    #[must_use]
    pub fn sizes(values: &Array) -> Vec<f64> {
        match values {
            Array::Float(values) => values.clone(),
            Array::Uint(values) => values.iter().map(|n| f64::from(*n)).collect(),
            Array::Vec3(values) => values.iter().map(|v| v.length()).collect(),
            Array::Vec4(values) => values.iter().map(|v| v.truncate().length()).collect(),
        }
    }
}

/// From nearly the lowest to nearly the highest of some values, and a little apart.
fn ends(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    let mut values: Vec<f64> = values.into_iter().filter(|v| v.is_finite()).collect();
    if values.is_empty() {
        return (0.0, 1.0);
    }
    values.sort_unstable_by(f64::total_cmp);
    let (low, high) = (values[values.len() / 50], values[(values.len() - 1) - values.len() / 50]);
    if low == 0.0 && high == 0.0 {
        return (0.0, 1.0);
    }
    // All the same: the middle of the scale.
    let least = 1e-3 * low.abs().max(high.abs()).max(1e-30);
    if high - low > least { (low, high) } else { (low - least, high + least) }
}

/// Red in the lowest byte.
#[must_use]
pub fn pack(rgb: [u8; 3]) -> u32 {
    u32::from_le_bytes([rgb[0], rgb[1], rgb[2], 255])
}

/// A colour in bytes.
#[must_use]
pub fn bytes(rgb: DVec3) -> [u8; 3] {
    let byte = |x: f64| u8::try_from(whole((255.0 * x).round().clamp(0.0, 255.0))).unwrap_or(u8::MAX);
    rgb.to_array().map(byte)
}

/// The colour of a group.
#[must_use]
pub fn group_color(group: u32) -> [u8; 3] {
    PALETTE[group as usize % PALETTE.len()]
}

/// The lowest value, three between, the highest: lighter from each to the next but the last.
const SCALE: [DVec3; 5] = [
    DVec3::new(0.26, 0.28, 0.84),
    DVec3::new(0.29, 0.54, 0.96),
    DVec3::new(0.52, 0.79, 0.94),
    DVec3::new(0.96, 0.90, 0.74),
    DVec3::new(1.0, 0.77, 0.38),
];

/// The colour at a part of the scale of values.
#[must_use]
pub fn value_color(part: f64) -> DVec3 {
    along(&SCALE, part)
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
            "column" => return Self::Column(settings.text("column").to_owned()),
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

    /// The ends of its scale, as shaders have them.
    pub(super) fn ends(&self) -> (f64, f64) {
        match self {
            Self::Speed { slow, fast } => (*slow, *fast),
            Self::Value(scaled) => scaled.ends(),
            Self::Given(_) | Self::Column(_) | Self::Heading => (0.0, 1.0),
        }
    }
    fn by_speed(particles: &State) -> Self {
        let (slow, fast) = ends(particles.velocity().iter().map(|v| v.length()));
        Self::Speed { slow, fast }
    }
}

#[cfg(all(test, feature = "panel"))]
mod tests {
    use super::*;

    #[test]
    fn a_scale_is_kept_until_it_is_outgrown_or_mostly_empty() {
        let speed = |slow, fast| Color::Speed { slow, fast };
        let known = speed(1.0, 3.0);
        for (own, fits) in [
            (speed(1.0, 3.0), true),
            (speed(0.1, 3.9), true),
            (speed(1.5, 2.6), true),
            (speed(1.5, 2.4), false),
            (speed(1.0, 4.1), false),
            (speed(-0.1, 3.0), false),
            (speed(8.0, 10.0), false),
        ] {
            assert_eq!(known.fits(&own), fits, "{own:?}");
        }
        let column = |low, high, logarithmic| {
            let column = Column::new("velocity", crate::kernel::Kind::Vector, "", "");
            Color::Value(Box::new(Scaled { column, low, high, logarithmic }))
        };
        assert!(column(1.0, 1e4, true).fits(&column(0.1, 1e4, true)));
        assert!(!column(1.0, 1e4, true).fits(&column(1e-3, 1e4, true)));
        assert!(column(1.0, 120.0, true).fits(&column(1.0, 80.0, false)));
        assert!(column(1.0, 80.0, false).fits(&column(1.0, 101.0, true)));
        assert!(!column(1.0, 1e4, true).fits(&column(0.0, 1e4, false)));
        assert!(column(1.0, 3.0, false).shows_as(&Color::Column("velocity".to_owned())));
        assert!(!column(1.0, 3.0, false).shows_as(&Color::Column("position".to_owned())));
    }
    #[test]
    fn what_rests_is_at_the_dark_end() {
        let mut rest = State::default();
        (0..3).for_each(|_| rest.push(DVec3::ZERO, DVec3::ZERO, 1.0, 0.0));
        assert_eq!(Color::by_speed(&rest), Color::Speed { slow: 0.0, fast: 1.0 });
    }
}
