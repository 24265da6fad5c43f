//! A centre that attracts.

use std::borrow::Cow;
use std::sync::Arc;

use glam::DVec3;

use super::{Component, EACH, Jacobian, Law, params};
use crate::kernel::Scalar;
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("position", Kind::Vector, Value::Vector(DVec3::ZERO), "the position of the centre at time 0 [length]"),
    Key::new("velocity", Kind::Vector, Value::Vector(DVec3::ZERO), "its velocity [length / time]; energy is conserved only if it is at rest"),
    Key::new("profile", Kind::Choice(PROFILES), Value::Text(Cow::Borrowed("point")), "the profile of the attraction"),
    Key::new("strength", Kind::Number, Value::Number(1.0), "point: G M [length³ / time²]; harmonic: ω² [1 / time²]; logarithmic: v₀² [length² / time²]"),
    Key::new("softening", Kind::NotNegative, Value::Number(0.0), "point, logarithmic: the core radius ε [length]"),
    EACH,
];

const PROFILES: &[&str] = &["point", "harmonic", "logarithmic"];

/// `attractor`: `point` φ = −k / √(d² + ε²); `harmonic` φ = k d² / 2; `logarithmic` φ = k ln(d² + ε²) / 2, which has a flat
/// rotation curve (Binney & Tremaine 2008, §2.3.2).
#[derive(Clone)]
pub struct Attractor(Settings);

impl Attractor {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Component for Attractor {
    fn laws(&self) -> Vec<Law> {
        let (position, velocity) = (self.0.vector("position"), self.0.vector("velocity"));
        let (strength, softening) = (self.0.number("strength"), self.0.number("softening"));
        let profile = PROFILES.iter().position(|p| *p == self.0.text("profile")).unwrap_or(0);
        let mut values = params(&self.0, &["position", "velocity", "strength", "softening"]);
        values.push(("profile".to_owned(), Scalar::Uint(u32::try_from(profile).unwrap_or(0))));
        let law = Law::each("attractor", crate::shader!("interactions/attractor.wgsl"), values, move |me, world| {
            let d = world.bounds.shortest(me.position - (position + velocity * world.time));
            let soft = d.length_squared() + softening * softening;
            let (pull, potential) = match profile {
                0 => (strength / (soft * soft.sqrt()), -strength / soft.sqrt()),
                1 => (strength, 0.5 * strength * d.length_squared()),
                _ => (strength / soft, 0.5 * strength * soft.ln()),
            };
            (-pull * d).extend(potential)
        });
        // The others pull less the further away one is, which no matrix of an implicit step should be made of.
        let linear = Jacobian::Each(Arc::new(move |_, _, dx, _| -strength * dx));
        vec![if profile == 1 { law.with_jacobian(linear) } else { law }]
    }
}
