//! Pedestrians that keep apart, press and rub.

use glam::{DVec3, DVec4};

use super::{Component, Law, Properties, SEE_NEAR, SKIN, SPECIES, over, params, species};
use crate::component::Largest;
use crate::crowds;
use crate::error::Error;
use crate::kernel::{Bounds, Column, World};
use crate::settings::{Key, Kind, Settings, Value};
use crate::visit::Particle;

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    Key::new("range", Kind::Positive, Value::Number(2.0), "the distance of centres up to which pedestrians act on each other [length]"),
    crowds::REPULSION,
    crowds::DECAY,
    crowds::STIFFNESS,
    crowds::FRICTION,
    Key::new("anisotropy", Kind::NotNegative, Value::Number(1.0), "λ, the part of the repulsion by pedestrians straight behind; 1: the same all round"),
    SPECIES,
    SEE_NEAR,
    SKIN,
];

/// `social_force`: pedestrians repel each other exponentially with distance; where they touch, a body force pushes them apart and
/// friction slows their sliding (Helbing, Farkas & Vicsek, Nature 407, 487, 2000). Repulsion may be weaker from behind (Helbing et al., Environ.
/// Plann. B 28, 361, 2001). Friction is along the velocity of the other relative to the pedestrian and across the line between them, so that its
/// power is never positive. With λ = 1 forces are equal and opposite; friction acts at the centres, and changes the angular momentum.
/// The exponential ends at the range: there it is A exp(−(range − R − R') / B).
#[derive(Clone)]
pub struct SocialForce(Settings);

impl SocialForce {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self(settings.clone())
    }
}

impl Component for SocialForce {
    fn columns(&self) -> Vec<Column> {
        vec![crowds::radius()]
    }
    fn check(&self, _: &Bounds) -> Result<(), Error> {
        let anisotropy = self.0.number("anisotropy");
        if anisotropy <= 1.0 {
            return Ok(());
        }
        let why = format!("pedestrians have anisotropy = {anisotropy}: λ is a part, from 0 (blind to what is behind) to 1 (the same all round)");
        Err(Error::Setting { key: "anisotropy", why })
    }
    fn properties(&self) -> Properties {
        let [range, decay] = ["range", "decay"].map(|name| self.0.number(name));
        let limits = [
            (0.5 * range, "its range is the largest sum of two radii"),
            (crowds::STEEPEST * decay, "the repulsion grows by e for each `decay` of an overlap, and would exceed single precision"),
        ];
        Properties {
            dissipates: vec!["social forces"],
            ignores_massless: true,
            turns: vec!["social forces"],
            presses: Some(crowds::Press::of(&self.0)),
            largest: limits.map(|(value, why)| Largest { column: "radius", value, why }).to_vec(),
            ..Properties::default()
        }
    }
    fn laws(&self) -> Vec<Law> {
        let press = crowds::Press::of(&self.0);
        let (anisotropy, (kind, kind_value)) = (self.0.number("anisotropy"), species(&self.0, "species"));
        let mut values = params(&self.0, &["repulsion", "decay", "stiffness", "friction", "anisotropy"]);
        values.push(("species".to_owned(), kind_value));
        let gather = move |me: &Particle, you: &Particle, r: DVec3, sum: &mut DVec3| {
            let distance = r.length();
            if !(kind.has(me) && kind.has(you) && distance > 0.0 && you.mass > 0.0) {
                return;
            }
            let n = -r / distance;
            let [mine, yours] = [me, you].map(crowds::radius_of);
            let weight = me.velocity.try_normalize().map_or(1.0, |ahead| anisotropy + (1.0 - anisotropy) * 0.5 * (1.0 - ahead.dot(n)));
            *sum += press.force(mine + yours - distance, n, you.velocity - me.velocity, weight);
        };
        let finish = |me: &Particle, sum: &DVec3, _: &World| {
            if me.mass > 0.0 { (*sum / me.mass).extend(0.0) } else { DVec4::ZERO }
        };
        let (over, wgsl) = (over(&self.0, None), crate::shader!("interactions/social_force.wgsl"));
        let law = Law::gathering("social_force", over, wgsl, values, gather, finish);
        vec![Law { reciprocal: anisotropy >= 1.0, ..law }]
    }
}
