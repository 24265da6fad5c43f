//! A heat bath with friction and noise.

use super::{Component, Problem, Properties, Stage};
use crate::component::bath::{Bath, TEMPERATURE, normals};
use crate::component::keys::SEED;
use crate::component::thermostat::decayed;
use crate::error::Error;
use crate::kernel::Plan;
use crate::settings::{Key, Kind, Settings, Value};

/// The keys in a scene.
pub const KEYS: &[Key] = &[
    TEMPERATURE,
    Key::new("friction", Kind::Positive, Value::Number(1.0), "γ, the rate at which velocities are forgotten [1 / time]"),
    SEED,
];

/// `langevin`: at the end of each step v ← c v + √((1 − c²) k T / m) n, c = exp(−γ dt), with normal numbers n (Bussi & Parrinello, Phys. Rev. E
/// 75, 056707, 2007). With `leapfrog` velocities have the Maxwell distribution up to an error of order dt², and exactly in harmonic
/// forces, where ⟨x²⟩ = k T / (m ω² (1 − ω² dt² / 4)). The numbers are counted by id, step and seed.
#[derive(Clone)]
pub struct Langevin {
    bath: Bath,
    friction: f64,
}

impl Langevin {
    /// From checked settings.
    #[must_use]
    pub fn new(settings: &Settings) -> Self {
        Self { bath: Bath::of(settings), friction: settings.number("friction") }
    }
}

impl Component for Langevin {
    fn properties(&self) -> Properties {
        let why = "langevin draws its noise for steps of one length";
        Properties { fixed_step: Some(why), constrains: true, thermostat: true, canonical: true, temperature: Some(self.bath.temperature), ..Properties::default() }
    }
    fn stage(&self, stage: Stage, plan: &mut Plan, problem: &Problem) -> Result<(), Error> {
        if stage == Stage::EndOfStep {
            let bath = self.bath;
            let file = crate::shader!("updaters/langevin.wgsl");
            plan.add(bath.kernel("langevin", file, ("FRICTION", self.friction), problem, move |me, x, host| {
                let world = host.world();
                let noise = (decayed(2.0 * x) * bath.temperature / me.mass).sqrt();
                (-x).exp() * me.velocity + noise * normals(bath.words(me, world.step), world.bounds.dimensions)
            })?);
        }
        Ok(())
    }
}
