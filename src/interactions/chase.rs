//! Predators that chase.

use glam::{DVec3, DVec4};

use super::{Component, Law, SEE_NEAR, SKIN, params, species, over};
use crate::kernel::World;
use crate::settings::{Key, Kind, Settings, Value};
use crate::visit::Particle;

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("range", Kind::Positive, Value::Number(1.0), "how far prey is seen [length]"),
    Key::new("max_speed", Kind::Positive, Value::Number(1.5), "the desired speed; for a limit see speed_limit [length / time]"),
    Key::new("max_force", Kind::Positive, Value::Number(1.5), "the maximum acceleration by steering [length / time²]"),
    Key::new("species", Kind::Species, Value::Number(1.0), "the species that chases"),
    Key::new("prey", Kind::Species, Value::Number(0.0), "the species that is chased"),
    SEE_NEAR,
    SKIN,
];

/// `chase`: predators steer to the middle of all prey in range. It does not act on prey: see `flee`.
#[derive(Clone)]
pub struct Chase(Settings);

impl Chase {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Component for Chase {
    fn laws(&self) -> Vec<Law> {
        let (speed, force) = (self.0.number("max_speed"), self.0.number("max_force"));
        let (predators, predators_value) = species(&self.0, "species");
        let (prey, prey_value) = species(&self.0, "prey");
        let mut values = params(&self.0, &["max_speed", "max_force"]);
        values.extend([("species".to_owned(), predators_value), ("prey".to_owned(), prey_value)]);
        let gather = move |me: &Particle, you: &Particle, r: DVec3, displacement: &mut DVec3| {
            if predators.has(me) && prey.has(you) {
                *displacement += r;
            }
        };
        let finish = move |me: &Particle, displacement: &DVec3, _: &World| match displacement.try_normalize() {
            Some(way) => (speed * way - me.velocity).clamp_length_max(force).extend(0.0),
            None => DVec4::ZERO,
        };
        let over = over(&self.0, prey.0);
        vec![Law::gathering("chase", over, crate::shader!("interactions/chase.wgsl"), values, gather, finish)]
    }
}
