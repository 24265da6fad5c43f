//! Bonds of finite extension.

use std::borrow::Cow;
use std::sync::Arc;

use glam::{DVec3, DVec4};

use super::{Component, Jacobian, Law, params};
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new(
        "max_length",
        Kind::Positive,
        Value::Number(1.5),
        "R₀, the length at which the energy of a bond is infinite: one that is found longer ends the run [length]",
    ),
    Key::new(
        "over",
        Kind::Choice(&["links"]),
        Value::Text(Cow::Borrowed("links")),
        "which pairs are evaluated: those connected by a spring or a rope: its stiffness and damping count, its rest length does not",
    ),
];

/// `fene`: the bonds of polymers, U = −½ K R₀² ln(1 − (r / R₀)²), with the stiffness K and the damping of each link (Kremer & Grest, J.
/// Chem. Phys. 92, 5057, 1990). They only pull: what keeps their ends apart is a law of all pairs, such as `wca`.
#[derive(Clone)]
pub struct Fene(Settings);

impl Fene {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Component for Fene {
    fn laws(&self) -> Vec<Law> {
        let longest = self.0.number("max_length");
        let left = move |r: DVec3| 1.0 - r.length_squared() / (longest * longest);
        let law = Law::links(
            "fene",
            crate::shader!("interactions/fene.wgsl"),
            params(&self.0, &["max_length"]),
            move |me, you, r, link, sum: &mut DVec4| {
                let left = left(r);
                if link.stiffness > 0.0 && left > 0.0 {
                    let square = r.length_squared();
                    let x = square / (longest * longest);
                    let spread = if x > 0.0 { -(-x).ln_1p() / x } else { 1.0 };
                    *sum += (link.stiffness / left * r).extend(0.5 * link.stiffness * square * spread);
                }
                let along = r.normalize_or_zero();
                *sum += (link.damping * (you.velocity - me.velocity).dot(along) * along).extend(0.0);
            },
            |me, sum| if me.mass > 0.0 { *sum / me.mass } else { DVec4::ZERO },
        );
        let jacobian = Jacobian::Links(Arc::new(move |_, _, r, link, dx, dv| {
            let (left, along) = (left(r), r.normalize_or_zero());
            let damped = link.damping * along.dot(dv) * along;
            if left <= 0.0 {
                return damped;
            }
            link.stiffness / left * (dx + (2.0 / left - 2.0) * along.dot(dx) * along) + damped
        }));
        vec![law.shorter_than(longest).with_jacobian(jacobian)]
    }
}
