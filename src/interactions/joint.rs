//! Joints that resist bending.

use std::borrow::Cow;

use glam::{DVec3, DVec4};

use super::{Component, Law, Over};
use crate::links::Corner;
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[Key::new(
    "over",
    Kind::Choice(&["joints"]),
    Value::Text(Cow::Borrowed("joints")),
    "what is evaluated: the three particles of a joint, which has its own stiffness",
)];

/// `joint`: E = ½ k (θ − θ₀)² at every joint, with θ the angle by which the way turns there, and θ₀ that at rest. A discrete elastica (Euler
/// 1744), without twist, has θ₀ = 0, and k = EI / ds at its inner joints and 2 EI / ds where it is clamped; the angle of two bonds is π − θ.
#[derive(Clone)]
pub struct Joint;

impl Joint {
    /// From checked settings.
    #[must_use]
    pub fn new(_: &Settings) -> Self {
        Self
    }
}

impl Component for Joint {
    fn laws(&self) -> Vec<Law> {
        let law = Law::corners("joint", Over::Joints, crate::shader!("interactions/joint.wgsl"), Vec::new(), |at, corner: &Corner, world| {
            let [there, on] = [(0, 1), (1, 2)].map(|(a, b)| world.bounds.shortest(at[b].position - at[a].position));
            let (Some(p), Some(q)) = (there.try_normalize(), on.try_normalize()) else { return DVec4::ZERO };
            let (sine, cosine) = (p.cross(q).length(), p.dot(q));
            let angle = sine.atan2(cosine);
            // The axis about which the way turns; k θ is the torque about it.
            let axis = p.cross(q).normalize_or_zero();
            let turn = angle - corner.rest;
            let torque = corner.stiffness * turn;
            // Across each of the two lies the way to a smaller angle.
            let [first, third]: [DVec3; 2] = [axis.cross(p) / -there.length(), axis.cross(q) / -on.length()];
            let pull = [first, -first - third, third][corner.place];
            (torque * pull).extend(0.5 * corner.stiffness * turn * turn)
        });
        vec![Law { reciprocal: true, ..law }]
    }
}
