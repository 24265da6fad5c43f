//! Air on cloth.

use std::borrow::Cow;

use glam::{DVec3, DVec4};

use super::wind::Gusts;
use super::{Component, Law, Over, params};
use crate::links::Corner;
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("wind", Kind::Vector, Value::Vector(DVec3::ZERO), "the mean velocity of the air [length / time]"),
    Key::new("density", Kind::NotNegative, Value::Number(1.2), "the density of the air [mass / length³]"),
    Key::new("drag", Kind::NotNegative, Value::Number(1.0), "the drag coefficient of a triangle that faces the wind"),
    Key::new("lift", Kind::NotNegative, Value::Number(0.5), "the lift coefficient"),
    Key::new("gust", Kind::NotNegative, Value::Number(0.0), "the amplitude of gusts, relative to the mean velocity"),
    Key::new("period", Kind::Positive, Value::Number(1.0), "the time from gust to gust [time]"),
    Key::new("wavelength", Kind::Positive, Value::Number(1.0), "the distance from gust to gust, along the wind [length]"),
    Key::new(
        "over",
        Kind::Choice(&["triangles"]),
        Value::Text(Cow::Borrowed("triangles")),
        "what is evaluated: the corners of each triangle of cloth",
    ),
];

/// `air`: drag against the motion of each triangle through the air, and lift across it, by the part of the area that faces
/// the wind (Ling, Damodaran & Gay 1996): ½ ρ w² A (C_D |cos α| along, C_L cos α sin α across).
#[derive(Clone)]
pub struct Air(Settings);

impl Air {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Component for Air {
    fn laws(&self) -> Vec<Law> {
        let [density, drag, lift] = ["density", "drag", "lift"].map(|name| self.0.number(name));
        let gusts = Gusts::new(self.0.vector("wind"), &self.0);
        let values = params(&self.0, &["wind", "density", "drag", "lift", "gust", "period", "wavelength"]);
        vec![Law::corners("air", Over::Triangles, crate::shader!("interactions/air.wgsl"), values, move |at, _: &Corner, world| {
            let [ab, ac] = [1, 2].map(|k| world.bounds.shortest(at[k].position - at[0].position));
            let air = gusts.air(at[0].position, world.time);
            let w = at.iter().map(|body| body.velocity).sum::<DVec3>() / 3.0 - air;
            let (area, Some(heading)) = (0.5 * ab.cross(ac).length(), w.try_normalize()) else { return DVec4::ZERO };
            let normal = ab.cross(ac).normalize_or_zero();
            let facing = heading.dot(normal);
            let pressure = 0.5 * density * w.length_squared() * area / 3.0;
            let across = normal - facing * heading;
            (-pressure * (drag * facing.abs() * heading + lift * facing * across)).extend(0.0)
        })]
    }
}
