//! Vicsek's model.

use std::borrow::Cow;
use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::{Component, Law, Properties, SEED, SEE_NEAR, SKIN, params, over, seed};
use crate::kernel::{Scalar, World};
use crate::settings::{Key, Kind, Settings, Value};
use crate::visit::Particle;
use crate::visit::random::{fraction, pcg4d, words};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("range", Kind::Positive, Value::Number(1.0), "the radius of the neighbourhood, which includes the particle itself [length]"),
    Key::new("speed", Kind::Positive, Value::Number(0.03), "the speed of all particles; v₀ of the paper is this times dt [length / time]"),
    Key::new("noise", Kind::NotNegative, Value::Number(2.0), "η: angular, the width of the random angle [0 to 2π]; vectorial, the length of the random vector [0 to 1]"),
    Key::new("noise_kind", Kind::Choice(KINDS), Value::Text(Cow::Borrowed("angular")), "whether the noise turns the mean heading, or adds to the headings"),
    SEED,
    SEE_NEAR,
    SKIN,
];

const KINDS: &[&str] = &["angular", "vectorial"];

/// `vicsek`: each particle takes the mean heading of its neighbours, with noise, at constant speed, in the plane (Vicsek, Czirók, Ben-Jacob,
/// Cohen & Shochet, PRL 75, 1226, 1995; vectorial noise: Grégoire & Chaté, PRL 92, 025702, 2004). It is a rule for whole
/// steps: under `forward_euler` places change by the old heading, as in the paper; under `symplectic_euler` by the new one,
/// which is another model, with other numbers. Under other integrators it is neither.
#[derive(Clone)]
pub struct Vicsek(Settings);

/// The headings in range, and how many.
#[derive(Default)]
struct Seen {
    heading: DVec2,
    neighbors: f64,
}

impl Vicsek {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

fn heading(v: DVec3) -> DVec2 {
    v.truncate().normalize_or_zero()
}

impl Component for Vicsek {
    fn properties(&self) -> Properties {
        Properties {
            statistics_radius: Some((self.0.number("range"), None)),
            fixed_step: Some("vicsek sets headings once in a step, and its noise is per step"),
            integrators: &["forward_euler", "symplectic_euler"],
            ..Properties::default()
        }
    }
    fn laws(&self) -> Vec<Law> {
        let (speed, eta, vectorial) = (self.0.number("speed"), self.0.number("noise"), self.0.text("noise_kind") == "vectorial");
        let [low, high] = words(self.0.whole("seed"));
        let mut values = params(&self.0, &["speed"]);
        values.push(("eta".to_owned(), Scalar::Float(eta)));
        values.push(("vectorial".to_owned(), Scalar::Uint(u32::from(vectorial))));
        values.extend(seed(&self.0));
        let gather = |_: &Particle, you: &Particle, _: DVec3, seen: &mut Seen| {
            seen.heading += heading(you.velocity);
            seen.neighbors += 1.0;
        };
        let finish = move |me: &Particle, seen: &Seen, world: &World| {
            let own = heading(me.velocity);
            let xi = fraction(pcg4d([me.id(), world.step, low, high])[0]) - 0.5;
            let sum = seen.heading + own;
            let way = if vectorial {
                sum + eta * (seen.neighbors + 1.0) * DVec2::from_angle(TAU * xi)
            } else {
                DVec2::from_angle(eta * xi).rotate(sum)
            };
            let way = way.try_normalize().or(own.try_normalize()).unwrap_or(DVec2::X);
            ((speed * way.extend(0.0) - me.velocity) / world.dt).extend(0.0)
        };
        let over = over(&self.0, None);
        vec![Law::gathering("vicsek", over, crate::shader!("interactions/vicsek.wgsl"), values, gather, finish)]
    }
}
