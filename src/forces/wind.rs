//! A wind in gusts.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::DVec3;

use super::{EACH, Force, Jacobian, Law, params};
use crate::settings::{Key, Kind, Settings, Value};

/// What a scene may say.
pub const KEYS: &[Key] = &[
    Key::new("velocity", Kind::Vector, Value::Vector(DVec3::X), "the mean velocity of the air [length / time]"),
    Key::new("rate", Kind::NotNegative, Value::Number(1.0), "how fast particles take the air's velocity [1 / time]"),
    Key::new("gust", Kind::NotNegative, Value::Number(0.0), "the strength of gusts, as a part of the mean"),
    Key::new("period", Kind::Positive, Value::Number(1.0), "the time from gust to gust [time]"),
    Key::new("wavelength", Kind::Positive, Value::Number(1.0), "the way from gust to gust, along the wind [length]"),
    EACH,
];

/// `wind`: a = γ (u − v), with u = (1 + s sin 2π (t / T − d / λ)) U and d the way along the wind: gusts travel downwind.
pub struct Wind(Settings);

impl Wind {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Force for Wind {
    fn laws(&self) -> Vec<Law> {
        let (wind, rate, gust) = (self.0.vector("velocity"), self.0.number("rate"), self.0.number("gust"));
        let (period, wavelength) = (self.0.number("period"), self.0.number("wavelength"));
        let values = params(&self.0, &["velocity", "rate", "gust", "period", "wavelength"]);
        vec![Law::each("wind", crate::shader!("forces/wind.wgsl"), values, move |me, world| {
            let along = me.position.dot(wind.normalize_or_zero());
            let phase = TAU * (world.time / period - along / wavelength).fract();
            ((wind * (1.0 + gust * phase.sin()) - me.velocity) * rate).extend(0.0)
        })
        .with_jacobian(Jacobian::Each(Arc::new(move |me, world, dx, dv| {
            let way = wind.normalize_or_zero();
            let phase = TAU * (world.time / period - me.position.dot(way) / wavelength).fract();
            rate * (-gust * phase.cos() * TAU / wavelength * way.dot(dx) * wind - dv)
        })))]
    }
}
