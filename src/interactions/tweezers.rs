//! A trap along a line.

use glam::DVec3;

use super::{Component, EACH, Law, params};
use crate::kernel::Scalar;
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("position", Kind::Vector, Value::Vector(DVec3::ZERO), "a point on the axis of the beam [length]"),
    Key::new("axis", Kind::Direction, Value::Vector(DVec3::Z), "the direction of the beam; in a periodic box the trap repeats across the sides that the beam is parallel to, and a slanted beam ends at those that it crosses"),
    Key::new("waist", Kind::Positive, Value::Number(1.0), "the distance w from the axis at which the trap is e² times shallower [length]"),
    Key::new("depth", Kind::Number, Value::Number(1.0), "the depth U of the trap, per mass; below 0 it repels [length² / time²]"),
    EACH,
];

/// `tweezers`: φ = −U exp(−2 ρ² / w²) at the distance ρ from a line, the trap of a beam with a Gaussian profile (Ashkin et al. 1986) of the same
/// width all along. It pulls most, by 2 U / (√e w), at ρ = w / 2. In a periodic box ρ is that of the nearest image across the sides that the line is parallel
/// to. The images of a line that crosses a side at a slant would come close to every place, so that it has none there: it ends, and energy changes where
/// particles cross that side within it.
#[derive(Clone)]
pub struct Tweezers(Settings);

impl Tweezers {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Component for Tweezers {
    fn laws(&self) -> Vec<Law> {
        let (position, axis) = (self.0.vector("position"), self.0.vector("axis").normalize_or_zero());
        let (waist, depth) = (self.0.number("waist"), self.0.number("depth"));
        let mut values = params(&self.0, &["position", "waist", "depth"]);
        values.push(("axis".to_owned(), Scalar::Vector(axis)));
        vec![Law::each("tweezers", crate::shader!("interactions/tweezers.wgsl"), values, move |me, world| {
            let away = me.position - position;
            // A line has images at a distance only across the sides that it does not cross.
            let d = DVec3::select(axis.cmpeq(DVec3::ZERO), world.bounds.shortest(away), away);
            let across = (d - axis * axis.dot(d)) / waist;
            let potential = -depth * (-2.0 * across.length_squared()).exp();
            (4.0 / waist * potential * across).extend(potential)
        })]
    }
}
