//! A goal to go to, or a roost to keep to.

use glam::{DVec3, DVec4};

use super::{Component, EACH, Law, SPECIES, params, species};
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("position", Kind::Vector, Value::Vector(DVec3::ZERO), "its position at time 0 [length]"),
    Key::new("velocity", Kind::Vector, Value::Vector(DVec3::ZERO), "its velocity [length / time]"),
    Key::new("max_speed", Kind::Positive, Value::Number(1.0), "the desired speed [length / time]"),
    Key::new("max_force", Kind::Positive, Value::Number(1.0), "the maximum acceleration by steering [length / time²]"),
    Key::new("slow_radius", Kind::NotNegative, Value::Number(0.5), "the radius within which particles slow down, to rest at the goal [length]"),
    Key::new("free_radius", Kind::NotNegative, Value::Number(0.0), "the radius within which particles are not steered: a roost [length]"),
    SPECIES,
    EACH,
];

/// `goal`: steers to a point, and slows down on arrival (Reynolds 1999). An `attractor` pulls without slowing particles down.
#[derive(Clone)]
pub struct Goal(Settings);

impl Goal {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Component for Goal {
    fn laws(&self) -> Vec<Law> {
        let (position, velocity) = (self.0.vector("position"), self.0.vector("velocity"));
        let number = |name| self.0.number(name);
        let (most, force, slow, free) =
            (number("max_speed"), number("max_force"), number("slow_radius"), number("free_radius"));
        let (kind, kind_value) = species(&self.0, "species");
        let names = ["position", "velocity", "max_speed", "max_force", "slow_radius", "free_radius"];
        let mut values = params(&self.0, &names);
        values.push(("species".to_owned(), kind_value));
        vec![Law::each("goal", crate::shader!("interactions/goal.wgsl"), values, move |me, world| {
            let r = world.bounds.shortest(position + velocity * world.time - me.position);
            let distance = r.length();
            if distance < free || !kind.has(me) {
                return DVec4::ZERO;
            }
            let speed = if distance < slow { most * distance / slow } else { most };
            (speed * r.normalize_or_zero() - me.velocity).clamp_length_max(force).extend(0.0)
        })]
    }
}
