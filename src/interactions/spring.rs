//! Springs and ropes.

use std::borrow::Cow;
use std::sync::Arc;

use glam::{DVec3, DVec4};

use super::{Component, Jacobian, Law};
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[Key::new(
    "over",
    Kind::Choice(&["links"]),
    Value::Text(Cow::Borrowed("links")),
    "which pairs are evaluated: those connected by a spring or a rope, which has its own length, stiffness and damping",
)];

/// `spring`: Hooke's law along every link, F = k (l − L) + c dl/dt, with the damping along the spring alone: pairs that move
/// or turn as a whole are not damped. A rope pulls, and is slack while it is shorter than L.
#[derive(Clone)]
pub struct Spring;

impl Spring {
    /// From checked settings.
    #[must_use]
    pub fn new(_: &Settings) -> Self {
        Self
    }
}

impl Component for Spring {
    fn laws(&self) -> Vec<Law> {
        vec![Law::links(
            "spring",
            crate::shader!("interactions/spring.wgsl"),
            Vec::new(),
            |me, you, r, link, sum: &mut DVec4| {
                let stretch = r.length() - link.rest;
                if link.rope && stretch <= 0.0 {
                    return;
                }
                let along = r.normalize_or_zero();
                let tension = link.stiffness * stretch + link.damping * (you.velocity - me.velocity).dot(along);
                let tension = if link.rope { tension.max(0.0) } else { tension };
                *sum += (tension * along).extend(0.5 * link.stiffness * stretch * stretch);
            },
            |me, sum| if me.mass > 0.0 { *sum / me.mass } else { DVec4::ZERO },
        )
        .with_jacobian(Jacobian::Links(Arc::new(|_, _, r, link, dx, dv| {
            let length = r.length();
            if link.rope && length <= link.rest {
                return DVec3::ZERO;
            }
            let along = r.normalize_or_zero();
            let across = if length > 0.0 { (1.0 - link.rest / length).max(0.0) } else { 1.0 };
            link.stiffness * (across * dx + (1.0 - across) * along.dot(dx) * along)
                + link.damping * along.dot(dv) * along
        })))]
    }
}
