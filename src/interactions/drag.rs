//! The resistance of a medium.

use std::sync::Arc;

use glam::DVec3;

use super::{Component, EACH, Jacobian, Law, params};
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("linear", Kind::NotNegative, Value::Number(0.0), "the rate of linear (Stokes) drag [1 / time]"),
    Key::new("quadratic", Kind::NotNegative, Value::Number(0.0), "the coefficient of quadratic (Newton) drag [1 / length]"),
    Key::new("wind", Kind::Vector, Value::Vector(DVec3::ZERO), "the velocity of the medium [length / time]"),
    EACH,
];

/// `drag`: a = −(γ + c |u|) u with u = v − wind; per unit mass, so that a light and a heavy particle slow down alike.
#[derive(Clone)]
pub struct Drag(Settings);

impl Drag {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Component for Drag {
    fn laws(&self) -> Vec<Law> {
        let (linear, quadratic, wind) = (self.0.number("linear"), self.0.number("quadratic"), self.0.vector("wind"));
        let values = params(&self.0, &["linear", "quadratic", "wind"]);
        vec![Law::each("drag", crate::shader!("interactions/drag.wgsl"), values, move |me, _| {
            let u = me.velocity - wind;
            (-(linear + quadratic * u.length()) * u).extend(0.0)
        })
        .with_jacobian(Jacobian::Each(Arc::new(move |me, _, _, dv| {
            let u = me.velocity - wind;
            let along = u.normalize_or_zero();
            -(linear + quadratic * u.length()) * dv - quadratic * u.dot(dv) * along
        })))]
    }
}
