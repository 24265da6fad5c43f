//! Wandering at random.

use std::f64::consts::TAU;

use glam::{DVec3, DVec4};

use super::{Component, EACH, Law, Properties, SEED, SPECIES, params, species, seed};
use crate::settings::{Key, Kind, Settings, Value};
use crate::visit::random::{fraction, pcg4d, words};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("strength", Kind::NotNegative, Value::Number(0.5), "σ: after the time t a velocity has changed by σ √t (rms), for any dt [length / time^(3/2)]"),
    SEED,
    SPECIES,
    EACH,
];

/// `wander`: a random walk of velocities, a = σ n / √dt with n a random direction; in the plane where all is in the plane.
/// The numbers are counted by id, step and seed: the same ones on every device, and in every stage of a step.
#[derive(Clone)]
pub struct Wander(Settings);

impl Wander {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Component for Wander {
    fn properties(&self) -> Properties {
        Properties { fixed_step: Some("a random walk has one kick per step, scaled by the time step"), ..Properties::default() }
    }
    fn laws(&self) -> Vec<Law> {
        let strength = self.0.number("strength");
        let [low, high] = words(self.0.whole("seed"));
        let (kind, kind_value) = species(&self.0, "species");
        let mut values = params(&self.0, &["strength"]);
        values.extend(seed(&self.0));
        values.push(("species".to_owned(), kind_value));
        vec![Law::each("wander", crate::shader!("interactions/wander.wgsl"), values, move |me, world| {
            if !kind.has(me) {
                return DVec4::ZERO;
            }
            let random = pcg4d([me.id(), world.step, low, high]);
            let angle = TAU * (fraction(random[0]) - 0.5);
            let z = if world.bounds.dimensions == 3 { 2.0 * fraction(random[1]) - 1.0 } else { 0.0 };
            let across = (1.0 - z * z).sqrt();
            (strength / world.dt.sqrt() * DVec3::new(across * angle.cos(), across * angle.sin(), z)).extend(0.0)
        })]
    }
}
