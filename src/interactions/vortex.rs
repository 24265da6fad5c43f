//! A whirl about an axis.

use std::sync::Arc;

use glam::DVec3;

use super::{Component, EACH, Jacobian, Law, params};
use crate::kernel::Scalar;
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("center", Kind::Vector, Value::Vector(DVec3::ZERO), "a point on the axis [length]"),
    Key::new("axis", Kind::Direction, Value::Vector(DVec3::Z), "the axis of rotation, by the right-hand rule"),
    Key::new("circulation", Kind::Number, Value::Number(1.0), "the circulation Γ at large radius [length² / time]"),
    Key::new("core", Kind::Positive, Value::Number(0.1), "the core radius, where the flow is fastest [length]"),
    Key::new("rate", Kind::NotNegative, Value::Number(1.0), "the rate at which particles adopt the velocity of the flow [1 / time]"),
    EACH,
];

/// `vortex`: a = γ (u − v), with u the flow of a Kaufmann vortex, `|u| = Γ r / 2π (r² + r_c²)`.
#[derive(Clone)]
pub struct Vortex(Settings);

impl Vortex {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Component for Vortex {
    fn laws(&self) -> Vec<Law> {
        let (center, axis) = (self.0.vector("center"), self.0.vector("axis").normalize_or_zero());
        let (circulation, core, rate) = (self.0.number("circulation"), self.0.number("core"), self.0.number("rate"));
        let mut values = params(&self.0, &["center", "circulation", "core", "rate"]);
        values.push(("axis".to_owned(), Scalar::Vector(axis)));
        vec![Law::each("vortex", crate::shader!("interactions/vortex.wgsl"), values, move |me, world| {
            let d = world.bounds.shortest(me.position - center);
            let across = d - axis * axis.dot(d);
            let u = axis.cross(across) * (circulation / (std::f64::consts::TAU * (across.length_squared() + core * core)));
            ((u - me.velocity) * rate).extend(0.0)
        })
        .with_jacobian(Jacobian::Each(Arc::new(move |_, _, _, dv| -rate * dv)))]
    }
}
