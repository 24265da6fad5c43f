//! A uniform acceleration.

use glam::DVec3;

use super::{Component, EACH, Law, params};
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("acceleration", Kind::Vector, Value::Vector(DVec3::new(0.0, 0.0, -9.81)), "the acceleration [length / time²]"),
    EACH,
];

/// `uniform`: a = g, φ = −g · x, with φ = 0 at the origin.
#[derive(Clone)]
pub struct Uniform(Settings);

impl Uniform {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Component for Uniform {
    fn laws(&self) -> Vec<Law> {
        let g = self.0.vector("acceleration");
        let values = params(&self.0, &["acceleration"]);
        vec![Law::each("uniform", crate::shader!("interactions/uniform.wgsl"), values, move |me, _| g.extend(-g.dot(me.position)))]
    }
}
