//! A wind in gusts.

use std::f64::consts::TAU;
use std::sync::Arc;

use glam::DVec3;

use super::{Component, EACH, Jacobian, Law, params};
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("velocity", Kind::Vector, Value::Vector(DVec3::X), "the mean velocity of the air [length / time]"),
    Key::new("rate", Kind::NotNegative, Value::Number(1.0), "the rate at which particles adopt the velocity of the air [1 / time]"),
    Key::new("gust", Kind::NotNegative, Value::Number(0.0), "the amplitude of gusts, relative to the mean velocity"),
    Key::new("period", Kind::Positive, Value::Number(1.0), "the time from gust to gust [time]"),
    Key::new("wavelength", Kind::Positive, Value::Number(1.0), "the distance from gust to gust, along the wind [length]"),
    EACH,
];

/// `wind`: a = γ (u − v), with u = (1 + s sin 2π (t / T − d / λ)) U and d the way along the wind: gusts travel downwind.
#[derive(Clone)]
pub struct Wind(Settings);

impl Wind {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

/// Air that blows in gusts, which travel with it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Gusts {
    /// The mean velocity \[length / time\].
    pub mean: DVec3,
    /// The strength of gusts, as a part of the mean.
    pub strength: f64,
    /// From gust to gust \[time\].
    pub period: f64,
    /// The same along the wind \[length\].
    pub wavelength: f64,
}

impl Gusts {
    /// Of a force that has keys for all but the mean.
    pub fn new(mean: DVec3, settings: &Settings) -> Self {
        let [strength, period, wavelength] = ["gust", "period", "wavelength"].map(|name| settings.number(name));
        Self { mean, strength, period, wavelength }
    }
    fn phase(&self, x: DVec3, time: f64) -> f64 {
        TAU * (time / self.period - x.dot(self.mean.normalize_or_zero()) / self.wavelength).fract()
    }
    /// The velocity of the air at a position \[length / time\].
    pub fn air(&self, x: DVec3, time: f64) -> DVec3 {
        self.mean * (1.0 + self.strength * self.phase(x, time).sin())
    }
}

impl Component for Wind {
    fn laws(&self) -> Vec<Law> {
        let (gusts, rate) = (Gusts::new(self.0.vector("velocity"), &self.0), self.0.number("rate"));
        let values = params(&self.0, &["velocity", "rate", "gust", "period", "wavelength"]);
        vec![Law::each("wind", crate::shader!("interactions/wind.wgsl"), values, move |me, world| {
            ((gusts.air(me.position, world.time) - me.velocity) * rate).extend(0.0)
        })
        .with_jacobian(Jacobian::Each(Arc::new(move |me, world, dx, dv| {
            let Gusts { mean, strength, wavelength, .. } = gusts;
            let steepness = -strength * gusts.phase(me.position, world.time).cos() * TAU / wavelength;
            rate * (steepness * mean.normalize_or_zero().dot(dx) * mean - dv)
        })))]
    }
}
