//! Prey that flee.

use glam::DVec3;

use super::{Component, Law, SEE_NEAR, SKIN, params, species, over};
use crate::kernel::World;
use crate::settings::{Key, Kind, Settings, Value};
use crate::visit::Particle;

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("range", Kind::Positive, Value::Number(1.0), "how far a predator is seen [length]"),
    Key::new("strength", Kind::NotNegative, Value::Number(5.0), "the acceleration away from a predator at distance 0 [length / time²]"),
    Key::new("species", Kind::Species, Value::Number(0.0), "the species that flees"),
    Key::new("predators", Kind::Species, Value::Number(1.0), "the species from which it flees"),
    SEE_NEAR,
    SKIN,
];

/// `flee`: away from every predator in range, the more the nearer it is. It does not act on predators.
#[derive(Clone)]
pub struct Flee(Settings);

impl Flee {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Component for Flee {
    fn laws(&self) -> Vec<Law> {
        let (range, strength) = (self.0.number("range"), self.0.number("strength"));
        let (prey, prey_value) = species(&self.0, "species");
        let (predators, predators_value) = species(&self.0, "predators");
        let mut values = params(&self.0, &["range", "strength"]);
        values.extend([("species".to_owned(), prey_value), ("predators".to_owned(), predators_value)]);
        let gather = move |me: &Particle, you: &Particle, r: DVec3, sum: &mut DVec3| {
            if prey.has(me) && predators.has(you) {
                *sum -= (1.0 - r.length() / range) * r.normalize_or_zero();
            }
        };
        let finish = move |_: &Particle, sum: &DVec3, _: &World| (strength * *sum).extend(0.0);
        let over = over(&self.0, predators.0);
        vec![Law::gathering("flee", over, crate::shader!("interactions/flee.wgsl"), values, gather, finish)]
    }
}
